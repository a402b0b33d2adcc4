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

/// The part of a link that satisfies a predicate, such as its lower part.
struct LinkPart {
  Index runs = 0;     ///< maximal runs around the vertex; 0 if the part is empty or the whole link
  bool empty = true;  ///< no element of the link is in the part
  bool whole = true;  ///< every element is

  /// The kind of the vertex, if this is the lower part of its link.
  VertexKind kind() const { return kind_of_link(runs, whole); }
};

/// Walks the link of v on the capped surface, a cycle: its neighbours, and at a boundary the loop's cap,
/// which is in the part if `cap_inside`. Calls inside(u), or inside(u, h) as above, once for each neighbour
/// u, and on_run(u) for one element of each run (u = kNone: the cap). O(degree).
template <class Inside, class OnRun>
LinkPart link_part(const TriangleMesh& mesh, Index v, bool cap_inside, Inside&& inside, OnRun&& on_run) {
  LinkPart part;
  const bool boundary = mesh.is_boundary_vertex(v);
  bool previous = cap_inside;
  bool first_inside = cap_inside;
  Index first = kNone;
  bool started = boundary;
  const auto note = [&](bool is_inside) {
    part.empty &= !is_inside;
    part.whole &= is_inside;
    previous = is_inside;
  };
  const auto enter = [&](Index u) {
    ++part.runs;
    on_run(u);
  };
  if (boundary) note(cap_inside);
  for_each_neighbor(mesh, v, [&](Index u, Index halfedge) {
    const bool is_inside = detail::visit_neighbor(inside, u, halfedge);
    if (!started) {
      started = true;
      first = u;
      first_inside = is_inside;
    } else if (is_inside && !previous) {
      enter(u);
    }
    note(is_inside);
  });
  if (first_inside && !previous) enter(first);
  return part;
}

/// The kind of v, where is_lower(u), or is_lower(u, h) as in for_each_neighbor(), says whether neighbour u is
/// lower; it is called once for each neighbour in turn. O(degree).
template <class IsLower>
VertexKind vertex_kind(const TriangleMesh& mesh, Index v, const IsLower& is_lower) {
  return link_part(mesh, v, /*cap_inside=*/false, is_lower, [](Index) {}).kind();
}

}  // namespace morsel::core
