// Quality measures of a quad mesh.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/triangle_search.h"

namespace morsel::mscomplex {

using core::Index;
using core::Point;

namespace {

constexpr std::size_t kGrain = 512;

/// Sums and extremes over quads.
struct Shape {
  double angle_sum = 0, angle_max = 0;
  double jacobian_sum = 0, jacobian_min = 1;
  double distance_sum = 0, distance_max = 0;
  std::size_t concave = 0;
};

Shape together(Shape a, const Shape& b) {
  a.angle_sum += b.angle_sum;
  a.angle_max = std::max(a.angle_max, b.angle_max);
  a.jacobian_sum += b.jacobian_sum;
  a.jacobian_min = std::min(a.jacobian_min, b.jacobian_min);
  a.distance_sum += b.distance_sum;
  a.distance_max = std::max(a.distance_max, b.distance_max);
  a.concave += b.concave;
  return a;
}

std::array<Point, 4> corners(const QuadMesh& mesh, std::size_t q) {
  std::array<Point, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = mesh.positions[mesh.quads[q][i]];
  return p;
}

/// Adds a quad and returns its area.
double add_quad(const std::array<Point, 4>& p, Shape& shape) {
  const Point normal = (p[2] - p[0]).cross(p[3] - p[1]);
  const double size = normal.norm();
  double least = 1;
  for (int i = 0; i < 4; ++i) {
    const Point u = p[(i + 1) % 4] - p[i];
    const Point v = p[(i + 3) % 4] - p[i];
    const Point turn = u.cross(v);
    const double angle = std::atan2(turn.norm(), u.dot(v)) * 180 / std::numbers::pi;
    // Towards the other side of the quad, the angle inside it is the rest of the circle.
    const bool is_reflex = turn.dot(normal) < 0;
    const double deviation = std::abs((is_reflex ? 360 - angle : angle) - 90);
    shape.angle_sum += deviation;
    shape.angle_max = std::max(shape.angle_max, deviation);
    const double lengths = u.norm() * v.norm() * size;
    least = std::min(least, lengths > 0 ? turn.dot(normal) / lengths : 0);
  }
  shape.jacobian_sum += least;
  shape.jacobian_min = std::min(shape.jacobian_min, least);
  if (least < 0) ++shape.concave;
  return size / 2;
}

void measure_valence(const QuadMesh& mesh, QuadQuality& quality) {
  std::vector<std::array<Index, 2>> sides;
  for (const auto& quad : mesh.quads)
    for (int i = 0; i < 4; ++i) sides.push_back({quad[i], quad[(i + 1) % 4]});
  std::sort(sides.begin(), sides.end());
  std::vector<Index> valence(mesh.positions.size(), 0);
  std::vector<bool> is_boundary(mesh.positions.size(), false);
  for (const auto& [from, to] : sides) {
    ++valence[from];
    if (std::binary_search(sides.begin(), sides.end(), std::array{to, from})) continue;
    ++valence[to];
    is_boundary[from] = is_boundary[to] = true;
  }
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (quality.valence.size() <= valence[v]) quality.valence.resize(valence[v] + 1, 0);
    ++quality.valence[valence[v]];
    if (valence[v] != (is_boundary[v] ? 3 : 4)) ++quality.extraordinary;
  }
}

void measure_patches(const QuadMesh& mesh, QuadQuality& quality) {
  for (std::size_t first = 0; first < mesh.quads.size();) {
    Shape shape;
    PatchQuality patch;
    std::size_t q = first;
    for (; q < mesh.quads.size() && mesh.patch[q] == mesh.patch[first]; ++q)
      patch.area += add_quad(corners(mesh, q), shape);
    patch.angle_mean = shape.angle_sum / (4 * static_cast<double>(q - first));
    patch.scaled_jacobian_min = shape.jacobian_min;
    quality.patches.push_back(patch);
    first = q;
  }
}

void measure_areas(const std::vector<double>& area, QuadQuality& quality) {
  const double count = static_cast<double>(area.size());
  double sum = 0;
  for (const double a : area) sum += a;
  quality.area_mean = sum / count;
  if (!(quality.area_mean > 0)) return;
  double squares = 0;
  for (const double a : area) squares += (a / quality.area_mean - 1) * (a / quality.area_mean - 1);
  quality.area_deviation = std::sqrt(squares / count);
  const auto [least, largest] = std::minmax_element(area.begin(), area.end());
  quality.area_min = *least / quality.area_mean;
  quality.area_max = *largest / quality.area_mean;
}

}  // namespace

QuadQuality measure(const QuadMesh& quads, const core::TriangleMesh& input, const core::Progress& progress) {
  QuadQuality quality;
  if (quads.quads.empty()) return quality;
  progress.update("measuring quads", 0);
  measure_valence(quads, quality);
  const TriangleSearch surface(input.positions(), input.triangles());
  std::vector<double> area(quads.quads.size());
  progress.update("measuring quads", 0.2);
  const Shape shape = core::parallel_reduce(
      0, quads.quads.size(), kGrain, Shape{},
      [&](std::size_t first, std::size_t last) {
        progress.throw_if_cancelled();
        Shape part;
        for (std::size_t q = first; q < last; ++q) {
          const std::array<Point, 4> p = corners(quads, q);
          area[q] = add_quad(p, part);
          const double middle = surface.distance((p[0] + p[1] + p[2] + p[3]) / 4);
          part.distance_sum += middle;
          part.distance_max = std::max(part.distance_max, middle);
          for (int i = 0; i < 4; ++i) {
            // An inner edge is seen from both of its quads.
            if (quads.quads[q][i] < quads.quads[q][(i + 1) % 4])
              part.distance_max = std::max(part.distance_max, surface.distance((p[i] + p[(i + 1) % 4]) / 2));
          }
        }
        return part;
      },
      [](const Shape& a, const Shape& b) { return together(a, b); });
  const double count = static_cast<double>(quads.quads.size());
  quality.angle_mean = shape.angle_sum / (4 * count);
  quality.angle_max = shape.angle_max;
  quality.scaled_jacobian_mean = shape.jacobian_sum / count;
  quality.scaled_jacobian_min = shape.jacobian_min;
  quality.concave = shape.concave;
  quality.distance_mean = shape.distance_sum / count;
  measure_areas(area, quality);
  measure_patches(quads, quality);
  progress.update("measuring quads", 0.6);

  const auto largest = [](double a, double b) { return std::max(a, b); };
  const double at_vertices = core::parallel_reduce(
      0, quads.positions.size(), kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t v = first; v < last; ++v)
          part = std::max(part, surface.distance(quads.positions[v]));
        return part;
      },
      largest);
  quality.distance_max = std::max(shape.distance_max, at_vertices);

  std::vector<core::Triangle> halves;
  halves.reserve(2 * quads.quads.size());
  for (const auto& q : quads.quads) {
    halves.push_back({q[0], q[1], q[2]});
    halves.push_back({q[0], q[2], q[3]});
  }
  const TriangleSearch back(quads.positions, halves);
  progress.update("measuring quads", 0.8);
  quality.distance_from_input = core::parallel_reduce(
      0, input.vertex_count(), kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        progress.throw_if_cancelled();
        double part = 0;
        for (std::size_t v = first; v < last; ++v)
          part = std::max(part, back.distance(input.position(static_cast<Index>(v))));
        return part;
      },
      largest);
  progress.update("measuring quads", 1);
  return quality;
}

}  // namespace morsel::mscomplex
