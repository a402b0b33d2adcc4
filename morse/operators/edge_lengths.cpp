#include "morsel/morse/operators/edge_lengths.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::TriangleMesh;

/// By how much two sides are to be longer than the third, in mean lengths.
constexpr double kMargin = 1e-6;

/// a² + b² − c²: four times a triangle's area times the cotangent of the angle that faces c.
double squares(double a, double b, double c) {
  if (a > b) std::swap(a, b);
  return a * a + (b - c) * (b + c);  // no cancellation where b and c are the long sides of a needle
}

}  // namespace

double triangle_area(const std::array<double, 3>& sides) {
  auto [c, b, a] = sides;
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0)) / 4;
}

std::array<double, 3> half_cotangents(const std::array<double, 3>& sides) {
  const auto [a, b, c] = sides;
  const double eightfold = 8 * triangle_area(sides);
  return {squares(b, c, a) / eightfold, squares(c, a, b) / eightfold, squares(a, b, c) / eightfold};
}

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  const double diagonal = mesh.bounding_box().diagonal();
  if (!(diagonal > 0))
    throw core::BadInput("the surface has no extent: all " + std::to_string(mesh.vertex_count()) +
                         " vertices are at one place");
  EdgeLengths result;
  result.unit = std::ldexp(1.0, std::ilogb(diagonal));
  result.lengths.resize(mesh.edge_count());
  core::parallel_for_each(result.lengths.size(), [&](std::size_t e) {
    const auto [a, b] = mesh.edge_vertices(static_cast<Index>(e));
    result.lengths[e] = ((mesh.position(a) / result.unit) - (mesh.position(b) / result.unit)).norm();
  });
  const auto mean = [&] {
    return std::accumulate(result.lengths.begin(), result.lengths.end(), 0.0) /
           static_cast<double>(result.lengths.size());
  };
  result.mean = mean();
  result.added = core::parallel_reduce(
      0, mesh.triangle_count(), core::kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (std::size_t t = first; t < last; ++t) {
          std::array<double, 3> l = result.sides(mesh, static_cast<Index>(t));
          std::sort(l.begin(), l.end());
          most = std::max(most, kMargin * result.mean - (l[0] - (l[2] - l[1])));
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  if (result.added == 0) return result;
  for (double& length : result.lengths) length += result.added;
  result.mean = mean();
  return result;
}

std::vector<double> cotangent_weights(const TriangleMesh& mesh, const EdgeLengths& lengths) {
  std::vector<double> weights(mesh.edge_count());
  core::parallel_for_each(weights.size(), [&](std::size_t e) {
    const auto half = [&](Index h) {
      const Index t = TriangleMesh::triangle_of(h);
      return half_cotangents(lengths.sides(mesh, t))[h % 3];
    };
    const Index h = mesh.edge_halfedge(static_cast<Index>(e));
    weights[e] = half(h) + (mesh.twin(h) == core::kNone ? 0 : half(mesh.twin(h)));
  });
  return weights;
}

std::vector<double> barycentric_areas(const TriangleMesh& mesh, const EdgeLengths& lengths) {
  std::vector<double> areas(mesh.vertex_count(), 0.0);
  core::parallel_for_each(areas.size(), [&](std::size_t v) {
    mesh.for_each_outgoing(static_cast<Index>(v), [&](Index h) {
      areas[v] += triangle_area(lengths.sides(mesh, TriangleMesh::triangle_of(h))) / 3;
    });
  });
  return areas;
}

}  // namespace morsel::morse
