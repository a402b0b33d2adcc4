#pragma once
/// Edges of triangles as sorted half-edges: for meshes whose edges may have any number of faces.

#include <algorithm>
#include <compare>
#include <cstddef>
#include <vector>

#include "morsel/core/parallel/interruptible.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// A half-edge with the ends of its edge: sorted, the half-edges of an edge follow one another.
struct EdgeSide {
  Index smaller;
  Index larger;
  Index halfedge;

  auto operator<=>(const EdgeSide&) const = default;
  bool same_edge(const EdgeSide& other) const { return smaller == other.smaller && larger == other.larger; }
};

inline EdgeSide edge_side(Index origin, Index end, Index halfedge) {
  const auto [smaller, larger] = std::minmax(origin, end);
  return {smaller, larger, halfedge};
}

/// Calls visit(first, last) with the range in `sorted` of each edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeSide>& sorted, Visit&& visit) {
  for (std::size_t first = 0; first < sorted.size();) {
    throw_if_stopped_at_times();
    std::size_t last = first + 1;
    while (last < sorted.size() && sorted[last].same_edge(sorted[first])) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace morsel::core
