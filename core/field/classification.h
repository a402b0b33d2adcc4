#pragma once
/// What the vertices of a field are: vertex_kind.h says by which rule.

#include <cstddef>

#include "morsel/core/field/link.h"
#include "morsel/core/field/link_changes.h"
#include "morsel/core/field/scalar_field.h"

namespace morsel::core {

/// Classifies one vertex by its link. O(degree).
inline VertexKind vertex_kind(const ScalarField& field, Index v) {
  const auto rank = field.ranks();
  const Index center = rank[v];
  return vertex_kind(field.mesh(), v, [&](Index u) { return rank[u] < center; });
}

/// The same from the counted changes of its link, which is walked only where the count is cut off.
inline VertexKind vertex_kind(const ScalarField& field, Index v, LinkChanges changes) {
  return changes.is_cut_off() ? vertex_kind(field, v) : changes.kind();
}

/// Minima, saddle vertices and maxima. O(n), parallel.
std::size_t critical_count(const ScalarField& field);

}  // namespace morsel::core
