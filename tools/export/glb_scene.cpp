#include "morsel/tools/export/glb_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "morsel/core/parallel/stop.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/tools/color/mark_sizes.h"
#include "morsel/tools/color/surface_colors.h"

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;

/// A sphere of radius 1 around the origin: positions are its normals, too.
struct Sphere {
  std::vector<Point> positions;
  std::vector<core::Triangle> triangles;
};

Sphere icosahedron() {
  const double a = 1 / std::sqrt(1 + std::numbers::phi * std::numbers::phi), b = a * std::numbers::phi;
  return {{{-a, b, 0},
           {a, b, 0},
           {-a, -b, 0},
           {a, -b, 0},
           {0, -a, b},
           {0, a, b},
           {0, -a, -b},
           {0, a, -b},
           {b, 0, -a},
           {b, 0, a},
           {-b, 0, -a},
           {-b, 0, a}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Each triangle in four.
Sphere subdivided(const Sphere& sphere) {
  Sphere finer{sphere.positions, {}};
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [place, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<Index>(finer.positions.size()));
    if (is_new) finer.positions.push_back((finer.positions[a] + finer.positions[b]).normalized());
    return place->second;
  };
  for (const auto& [a, b, c] : sphere.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const core::Triangle& t : {core::Triangle{a, ab, ca}, core::Triangle{ab, b, bc},
                                    core::Triangle{ca, bc, c}, core::Triangle{ab, bc, ca}})
      finer.triangles.push_back(t);
  }
  return finer;
}

/// 320, 80 or 20 triangles, so that all of them are at most some 800,000 up to 40,000 points.
Sphere sphere_for(std::size_t points) {
  Sphere sphere = icosahedron();
  for (const std::size_t bound : {std::size_t{10'000}, std::size_t{2'500}})
    if (points <= bound) sphere = subdivided(sphere);
  return sphere;
}

struct PointHash {
  std::size_t operator()(const Point& p) const {
    std::size_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = hash * 0x9E3779B97F4A7C15 + std::hash<double>()(p[axis]);
    return hash;
  }
};

constexpr Index kSides = 6;  // of a tube

/// Appends a tube along the line, whose points differ from those before: a ring of corners at each.
void add_tube(const std::vector<Point>& line, double radius, std::vector<Point>& positions,
              std::vector<Point>& normals, std::vector<core::Triangle>& triangles) {
  Point side = Point::Zero();
  Index before = core::kNone;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point in = i > 0 ? Point(line[i] - line[i - 1]).stableNormalized() : Point::Zero();
    const Point out = i + 1 < line.size() ? Point(line[i + 1] - line[i]).stableNormalized() : Point::Zero();
    Point along = in + out;
    if (along.norm() < 0.1) along = i + 1 < line.size() ? out : in;  // back where it came from
    along.normalize();
    side -= along * along.dot(side);  // of the ring before: so the tube does not twist
    if (side.norm() < 0.1) side = along.unitOrthogonal();
    side.normalize();
    const Point up = along.cross(side);
    const Index first = static_cast<Index>(positions.size());
    for (Index k = 0; k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      const Point normal = std::cos(angle) * side + std::sin(angle) * up;
      normals.push_back(normal);
      positions.emplace_back(line[i] + radius * normal);
    }
    for (Index k = 0; before != core::kNone && k < kSides; ++k) {
      const Index next = (k + 1) % kSides;
      triangles.push_back({before + k, before + next, first + next});
      triangles.push_back({before + k, first + next, first + k});
    }
    before = first;
  }
}

}  // namespace

std::vector<SceneMark> marks_of(const morse::CriticalPoints& points, std::span<const Index> places) {
  std::vector<SceneMark> marks;
  for (std::size_t i = 0; i < points.points.size(); ++i)
    marks.push_back({places.empty() ? points.points[i].vertex : places[i], points.points[i].type});
  return marks;
}

std::vector<SceneMark> marks_of(const MadePoints& made) {
  std::vector<SceneMark> marks;
  for (std::size_t i = 0; i < made.chosen.points.size(); ++i)
    marks.push_back({made.places[i], made.chosen.points[i].candidate.point.type});
  return marks;
}

GlbScene::GlbScene(const core::TriangleMesh& mesh)
    : mesh_(mesh), triangles_(mesh.triangles().begin(), mesh.triangles().end()), diagonal_(0), area_(0) {
  const auto [unit, exponent] = morse::unit_sized(mesh);  // so that no product of lengths overflows
  normals_ = morse::vertex_normals(unit);
  const std::vector<double> signs = morse::outward_signs(unit);
  for (core::Triangle& triangle : triangles_)
    if (signs[mesh.component_of_vertex(triangle[0])] < 0) std::swap(triangle[1], triangle[2]);
  const double diagonal = unit.bounding_box().diagonal();
  diagonal_ = std::ldexp(diagonal, exponent);
  if (!(diagonal > 0)) return;
  for (const core::Triangle& t : unit.triangles()) {
    const Point& a = unit.position(t[0]);
    area_ += (unit.position(t[1]) - a).cross(unit.position(t[2]) - a).norm() / 2;
  }
  area_ /= diagonal * diagonal;
}

void GlbScene::add_surface(std::vector<Color> colors) {
  parts_.push_back({"surface",
                    {mesh_.positions().begin(), mesh_.positions().end()},
                    normals_,
                    triangles_,
                    std::move(colors),
                    Color(1, 1, 1)});
}

void GlbScene::add_segments(std::span<const Index> labels, std::span<const Color> palette) {
  Part part{"surface", {}, {}, {}, {}, Color(1, 1, 1)};
  // By vertex, the labels of triangles there that have it already, and where.
  std::vector<std::vector<std::pair<Index, Index>>> made(mesh_.vertex_count());
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    core::Triangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = triangles_[t][i];
      const auto found = std::ranges::find(made[v], labels[t], &std::pair<Index, Index>::first);
      if (found != made[v].end()) {
        triangle[i] = found->second;
        continue;
      }
      triangle[i] = static_cast<Index>(part.positions.size());
      made[v].emplace_back(labels[t], triangle[i]);
      part.positions.push_back(mesh_.position(v));
      part.normals.push_back(normals_[v]);
      part.colors.push_back(palette[labels[t]]);
    }
    part.triangles.push_back(triangle);
  }
  parts_.push_back(std::move(part));
}

void GlbScene::add_marks(std::span<const SceneMark> marks) {
  const double radius = mark_sizes(area_, marks.size()).ball * diagonal_;
  const Sphere sphere = sphere_for(marks.size());
  using morse::CriticalType;
  for (const auto& [type, name] :
       {std::pair{CriticalType::minimum, "minima"}, std::pair{CriticalType::saddle, "saddles"},
        std::pair{CriticalType::maximum, "maxima"}}) {
    Part part{name, {}, {}, {}, {}, color_of(type)};
    for (const SceneMark& mark : marks) {
      if (mark.type != type) continue;
      core::throw_if_stopped();
      const Index first = static_cast<Index>(part.positions.size());
      const Point center = mesh_.position(mark.vertex) + 0.3 * radius * normals_[mark.vertex];
      for (const Point& p : sphere.positions) {
        part.positions.emplace_back(center + radius * p);
        part.normals.push_back(p);
      }
      for (const auto& [a, b, c] : sphere.triangles)
        part.triangles.push_back({first + a, first + b, first + c});
    }
    parts_.push_back(std::move(part));
  }
}

void GlbScene::add_arcs(const mscomplex::MorseSmaleComplex& complex, std::size_t marks) {
  const double radius = mark_sizes(area_, marks).tube * diagonal_;
  using mscomplex::ArcKind;
  for (const auto& [kind, name] :
       {std::pair{ArcKind::descending, "descending arcs"}, std::pair{ArcKind::ascending, "ascending arcs"}}) {
    Part part{name, {}, {}, {}, {}, color_of(kind)};
    std::unordered_set<Point, PointHash> drawn;
    std::vector<Point> line;
    for (Index a = 0; a < complex.arc_count(); ++a) {
      if (mscomplex::MorseSmaleComplex::arc_kind(a) != kind) continue;
      core::throw_if_stopped();
      complex.trace(a, line);
      line.erase(std::unique(line.begin(), line.end()), line.end());
      // Arcs that meet share the rest of their way: this one ends where another one was before. The first
      // point is the saddle, where several begin.
      std::size_t length = 1;
      while (length < line.size() && drawn.insert(line[length++]).second) {
      }
      line.resize(length);
      if (length > 1) add_tube(line, radius, part.positions, part.normals, part.triangles);
    }
    parts_.push_back(std::move(part));
  }
}

void GlbScene::write(const core::FileTarget& target, const Provenance& provenance, core::Sync sync) const {
  std::vector<GlbPart> parts;
  for (const Part& part : parts_)
    parts.push_back({part.name, part.positions, part.normals, part.triangles, part.color, part.colors});
  write_glb(target, parts, provenance.json(), sync);
}

}  // namespace morsel::tools
