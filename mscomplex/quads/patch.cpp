#include "morsel/mscomplex/quads/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "morsel/core/error.h"
#include "morsel/mscomplex/quads/disc_embedding.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::Point;
using Eigen::Vector2d;

namespace {

/// Rounds of reducing the stretch of a patch's parametrisation.
constexpr int kStretchRounds = 30;

std::string name_of(Index q) { return "patch " + std::to_string(q); }

Index halfedge(const LayoutMesh& mesh, Index from, Index to) {
  const Index h = mesh.leaving_for(from, to);
  if (h == kNone) throw std::logic_error("quad layout: an arc leaves the edges");
  return h;
}

}  // namespace

LayoutMesh labelled_surface(const QuadLayout& layout) {
  LayoutMesh mesh(layout.surface);
  std::vector<bool> on_arc(mesh.vertex_count(), false);
  for (std::size_t a = 0; a < layout.arcs.size(); ++a) {
    const auto& arc = layout.arcs[a];
    on_arc[arc.front()] = true;
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
      on_arc[arc[i + 1]] = true;
      mesh.set_label(halfedge(mesh, arc[i], arc[i + 1]), static_cast<Index>(a));
    }
  }
  for (std::size_t n = layout.node_vertex.size() - layout.cap_count(); n < layout.node_vertex.size(); ++n) {
    const Index start = mesh.leaving(layout.node_vertex[n]);
    Index h = start;
    do {
      mesh.set_label(LayoutMesh::next(h), LayoutMesh::kRim);
      mesh.set_label(h, LayoutMesh::kRim);  // fans are not parametrised
      on_arc[mesh.target(h)] = true;
      h = mesh.next_around(h);
    } while (h != start);
  }
  const Index inner = mesh.vertex_count();
  const auto lies_on_arc = [&](Index v) { return v < inner && on_arc[v]; };
  for (Index h = 0; h < mesh.halfedge_count(); ++h)  // among them those that get new numbers meanwhile
    if (mesh.is_free(h) && lies_on_arc(mesh.origin(h)) && lies_on_arc(mesh.target(h)))
      mesh.split_edge(h, 0.5);
  return mesh;
}

PatchMap find_patch(const LayoutMesh& mesh, const QuadLayout& layout, Index q, DiscFinder& finder) {
  const std::array<Index, 4>& arcs = layout.patches[q].arcs;
  const auto& first = layout.arcs[arcs[3]];
  PatchMap patch;
  patch.disc = finder.find(halfedge(mesh, first[0], first[1]), name_of(q));
  const Index size = patch.disc.border_size();
  Index at = 0;
  for (int side = 0; side < 4; ++side) {
    patch.corner.push_back(at);
    if (side == 3 && layout.is_cap(layout.patches[q].nodes[2])) {
      while (at < size && mesh.label(patch.disc.border[at]) == LayoutMesh::kRim) ++at;
      patch.corner.push_back(at);
    }
    const Index arc = arcs[(side + 3) % 4];
    const auto& vertices = layout.arcs[arc];
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i, ++at) {
      const Index here = side % 2 == 0 ? vertices[i] : vertices[vertices.size() - 1 - i];
      if (at >= size || mesh.label(patch.disc.border[at]) != arc || patch.disc.vertex[at] != here)
        throw std::logic_error("quad layout: the border of " + name_of(q) + " is not that of its arcs");
    }
  }
  patch.corner.push_back(at);
  if (at != size)
    throw std::logic_error("quad layout: the border of " + name_of(q) + " is longer than that of its arcs");
  return patch;
}

Vector2d polygon_corner(int sides, int i) {
  if (sides == 4) return {i % 4 == 1 || i % 4 == 2 ? 1 : 0, i % 4 >= 2 ? 1 : 0};
  const double angle = 2 * std::numbers::pi * (i % sides) / sides;
  return {std::cos(angle), std::sin(angle)};
}

void parametrise(const LayoutMesh& mesh, Index q, PatchMap& patch) {
  patch.place.assign(patch.disc.vertex_count(), Vector2d::Zero());
  for (int side = 0; side < patch.sides(); ++side) {
    const Index first = patch.corner[side];
    const Index last = patch.corner[side + 1];
    const Vector2d a = polygon_corner(patch.sides(), side);
    const Vector2d b = polygon_corner(patch.sides(), side + 1);
    const std::vector<double> share = share_along_border(mesh, patch.disc, first, last, 1e-6);
    for (Index i = first; i < last; ++i) patch.place[i] = a + share[i - first] * (b - a);
  }
  embed_inside(mesh, patch.disc, kStretchRounds, patch.place, name_of(q));
}

namespace {

/// Places in the square from (−1, −1) to (1, 1), in cells.
class Buckets {
 public:
  explicit Buckets(const std::vector<Vector2d>& places)
      : cells_(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(places.size()))))),
        inside_(std::size_t(cells_) * cells_) {
    for (std::size_t i = 0; i < places.size(); ++i)
      inside_[std::size_t(cell(places[i].y())) * cells_ + cell(places[i].x())].push_back(
          static_cast<Index>(i));
  }
  template <class Visit>
  void for_each_near(const Vector2d& low, const Vector2d& high, const Visit& visit) const {
    for (int y = cell(low.y()); y <= cell(high.y()); ++y)
      for (int x = cell(low.x()); x <= cell(high.x()); ++x)
        for (const Index i : inside_[std::size_t(y) * cells_ + x]) visit(i);
  }

 private:
  int cell(double x) const { return std::clamp(static_cast<int>((x + 1) / 2 * cells_), 0, cells_ - 1); }
  int cells_;
  std::vector<std::vector<Index>> inside_;
};

}  // namespace

void sample_inside(const LayoutMesh& mesh, Index q, const PatchMap& patch,
                   const std::vector<Vector2d>& places, Point* samples) {
  // Because of rounding a point may lie between triangles.
  const Vector2d tolerance = Vector2d::Constant(1e-9);
  const Buckets buckets(places);
  std::vector<double> best(places.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < patch.disc.triangles.size(); ++k) {
    std::array<Vector2d, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = patch.place[patch.disc.corner[3 * k + i]];
    const Vector2d u = p[1] - p[0];
    const Vector2d v = p[2] - p[0];
    const double area = u.x() * v.y() - u.y() * v.x();
    if (!(area > 0)) continue;
    const Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]) - tolerance;
    const Vector2d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]) + tolerance;
    const Index h = 3 * patch.disc.triangles[k];
    buckets.for_each_near(low, high, [&](Index at) {
      if ((places[at].array() < low.array()).any() || (places[at].array() > high.array()).any()) return;
      const Vector2d x = places[at] - p[0];
      std::array<double, 3> w{};
      w[1] = (x.x() * v.y() - x.y() * v.x()) / area;
      w[2] = (u.x() * x.y() - u.y() * x.x()) / area;
      w[0] = 1 - w[1] - w[2];
      const double least = std::min({w[0], w[1], w[2]});
      if (least <= best[at]) return;
      best[at] = least;
      double sum = 0;
      for (double& weight : w) sum += weight = std::max(weight, 0.0);
      samples[at] = (w[0] * mesh.position(mesh.origin(h)) + w[1] * mesh.position(mesh.origin(h + 1)) +
                     w[2] * mesh.position(mesh.origin(h + 2))) /
                    sum;
    });
  }
  for (const double least : best)
    if (!(least >= -1e-3))
      throw core::BadInput(
          name_of(q) + " (" + std::to_string(patch.disc.triangles.size()) +
          " triangles) cannot be parametrised in double precision: it is too long and thin; a field "
          "with more evenly spread critical points, or more relaxation of the layout, would help");
}

}  // namespace morsel::mscomplex
