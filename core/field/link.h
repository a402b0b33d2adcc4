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

/// A neighbour in the link of a vertex, or the cap of the vertex's boundary loop.
struct LinkElement {
  Index vertex = kNone;   ///< kNone for the cap
  bool is_lower = false;  ///< than the vertex; the cap is higher
};

/// Calls visit(a, b) for each two consecutive elements of the link of v on the capped surface, a cycle:
/// counter-clockwise, from the cap on at a boundary. is_lower(u), or is_lower(u, h) as above, says whether
/// neighbour u is lower; it is called once for each neighbour in turn. O(degree).
template <class IsLower, class Visit>
void for_each_link_pair(const TriangleMesh& mesh, Index v, const IsLower& is_lower, const Visit& visit) {
  LinkElement first;
  LinkElement previous;
  bool started = mesh.is_boundary_vertex(v);  // with the cap
  for_each_neighbor(mesh, v, [&](Index u, Index halfedge) {
    const LinkElement here{u, detail::visit_neighbor(is_lower, u, halfedge)};
    if (started) {
      visit(previous, here);
    } else {
      started = true;
      first = here;
    }
    previous = here;
  });
  visit(previous, first);
}

/// The kind of v, by is_lower as above. The cap of a boundary loop is higher. O(degree).
template <class IsLower>
VertexKind vertex_kind(const TriangleMesh& mesh, Index v, const IsLower& is_lower) {
  Index runs = 0;  // maximal runs of lower elements around v
  bool whole = true;
  for_each_link_pair(mesh, v, is_lower, [&](const LinkElement& a, const LinkElement& b) {
    if (b.is_lower && !a.is_lower) ++runs;
    whole &= b.is_lower;
  });
  return kind_of_link(runs, whole);
}

}  // namespace morsel::core
