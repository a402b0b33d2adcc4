#pragma once
/// The link of a vertex on the capped surface, walked once: for classification and union-find sweeps.

#include <type_traits>

#include "morsel/core/field/vertex_kind.h"
#include "morsel/core/mesh/mesh.h"

namespace morsel::core {

namespace detail {
template <class Visit>
decltype(auto) visit_neighbor(Visit& visit, Index u, [[maybe_unused]] Index halfedge) {
  if constexpr (std::is_invocable_v<Visit&, Index, Index>)
    return visit(u, halfedge);
  else
    return visit(u);
}
}  // namespace detail

/// Calls visit(u) once for each neighbour u of v, counter-clockwise: a full turn, or from one boundary
/// neighbour to the other. Or visit(u, h) with the half-edge from v to u; h is kNone for the last
/// neighbour at a boundary, to which no half-edge leads. O(degree).
template <class Visit>
void for_each_neighbor(const TriangleMesh& mesh, Index v, Visit&& visit) {
  const Triangle* const triangles = mesh.triangles().data();
  const Index* const twins = mesh.twins().data();
  const Index start = mesh.vertex_halfedge(v);
  Index h = start;
  Index apex = kNone;
  do {
    const Index t = h / 3;
    const Index i = h - 3 * t;
    const Index previous = i == 0 ? 2 : i - 1;
    detail::visit_neighbor(visit, triangles[t][3 - i - previous], h);
    apex = triangles[t][previous];
    h = twins[3 * t + previous];
  } while (h != start && h != kNone);
  if (h == kNone) detail::visit_neighbor(visit, apex, kNone);
}

/// The kind of v, where is_lower(u), or is_lower(u, h) as above, says whether neighbour u is lower; it is
/// called once for each neighbour in turn. The cap of a boundary loop is higher. O(degree).
template <class IsLower>
VertexKind vertex_kind(const TriangleMesh& mesh, Index v, const IsLower& is_lower) {
  const bool boundary = mesh.is_boundary_vertex(v);
  Index runs = 0;  // maximal runs of lower neighbours around v
  bool whole = !boundary;
  bool previous = false;
  bool first = false;
  bool started = boundary;  // the walk around an inner vertex closes at its first neighbour
  for_each_neighbor(mesh, v, [&](Index u, Index halfedge) {
    const bool lower = detail::visit_neighbor(is_lower, u, halfedge);
    if (!started) {
      started = true;
      first = lower;
    } else if (lower && !previous) {
      ++runs;
    }
    whole &= lower;
    previous = lower;
  });
  if (first && !previous) ++runs;
  return kind_of_link(runs, whole);
}

}  // namespace morsel::core
