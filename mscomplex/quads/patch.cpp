#include "morsel/mscomplex/quads/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "morsel/core/error.h"
#include "morsel/mscomplex/quads/disc_embedding.h"

namespace morsel::mscomplex {

using core::Index;
using core::kNone;
using core::Point;
using Eigen::Vector2d;

namespace {

/// Rounds of evening out what a patch's parametrisation makes tiny.
constexpr int kStretchRounds = 30;

std::string name_of(Index q) { return "patch " + std::to_string(q); }

Index halfedge(const LayoutMesh& mesh, Index from, Index to) {
  const Index start = mesh.leaving(from);
  for (Index h = start;;) {
    if (mesh.target(h) == to) return h;
    h = mesh.next_around(h);
    if (h == start) throw std::logic_error("quad layout: an arc leaves the edges");
  }
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
  Index at = 0;
  for (int side = 0; side < 4; ++side) {
    patch.corner[side] = at;
    const Index arc = arcs[(side + 3) % 4];
    const auto& vertices = layout.arcs[arc];
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i, ++at) {
      const Index here = side % 2 == 0 ? vertices[i] : vertices[vertices.size() - 1 - i];
      if (at >= patch.disc.border_size() || mesh.label(patch.disc.border[at]) != arc ||
          patch.disc.vertex[at] != here)
        throw std::logic_error("quad layout: the border of " + name_of(q) + " is not its four arcs");
    }
  }
  patch.corner[4] = at;
  if (at != patch.disc.border_size())
    throw std::logic_error("quad layout: the border of " + name_of(q) + " is longer than its four arcs");
  return patch;
}

void parametrise(const LayoutMesh& mesh, Index q, PatchMap& patch) {
  static const std::array<Vector2d, 5> corners = {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1),
                                                  Vector2d(0, 1), Vector2d(0, 0)};
  patch.place.assign(patch.disc.vertex_count(), Vector2d::Zero());
  for (int side = 0; side < 4; ++side) {
    const std::vector<double> share =
        share_along_border(mesh, patch.disc, patch.corner[side], patch.corner[side + 1], 1e-6);
    for (Index i = patch.corner[side]; i < patch.corner[side + 1]; ++i)
      patch.place[i] = corners[side] + share[i - patch.corner[side]] * (corners[side + 1] - corners[side]);
  }
  embed_inside(mesh, patch.disc, kStretchRounds, patch.place, name_of(q));
}

void sample_inside(const LayoutMesh& mesh, Index q, const PatchMap& patch, Index n, Point* samples) {
  constexpr double kTolerance = 1e-7;  // of a triangle that a point may lie outside it, for rounding's sake
  const Index inner = n - 1;
  const std::size_t count = std::size_t{inner} * inner;
  std::vector<double> best(count, -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < patch.disc.triangles.size(); ++k) {
    std::array<Vector2d, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = n * patch.place[patch.disc.corner[3 * k + i]];
    const Vector2d u = p[1] - p[0];
    const Vector2d v = p[2] - p[0];
    const double area = u.x() * v.y() - u.y() * v.x();
    if (!(area > 0)) continue;
    const auto first = [&](int axis) {
      return static_cast<Index>(
          std::max(1.0, std::ceil(std::min({p[0][axis], p[1][axis], p[2][axis]}) - kTolerance)));
    };
    const auto last = [&](int axis) {
      return static_cast<Index>(std::clamp(
          std::floor(std::max({p[0][axis], p[1][axis], p[2][axis]}) + kTolerance), 0.0, double(inner)));
    };
    const Index h = 3 * patch.disc.triangles[k];
    for (Index j = first(1); j <= last(1); ++j)
      for (Index i = first(0); i <= last(0); ++i) {
        const Vector2d x = Vector2d(i, j) - p[0];
        std::array<double, 3> w;
        w[1] = (x.x() * v.y() - x.y() * v.x()) / area;
        w[2] = (u.x() * x.y() - u.y() * x.x()) / area;
        w[0] = 1 - w[1] - w[2];
        const double least = std::min({w[0], w[1], w[2]});
        const std::size_t at = std::size_t{j - 1} * inner + (i - 1);
        if (least <= best[at]) continue;
        best[at] = least;
        double sum = 0;
        for (double& weight : w) sum += weight = std::max(weight, 0.0);
        samples[at] = (w[0] * mesh.position(mesh.origin(h)) + w[1] * mesh.position(mesh.origin(h + 1)) +
                       w[2] * mesh.position(mesh.origin(h + 2))) /
                      sum;
      }
  }
  for (const double least : best)
    if (!(least >= -1e-3))
      throw core::BadInput(
          name_of(q) + " (" + std::to_string(patch.disc.triangles.size()) +
          " triangles) cannot be parametrised in double precision: it is too long and thin; a field "
          "with more evenly spread critical points, or more relaxation of the layout, would help");
}

}  // namespace morsel::mscomplex
