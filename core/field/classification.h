#pragma once
/// What the vertices of a field are: vertex_kind.h says by which rule.

#include <cstddef>

#include "morsel/core/field/link.h"
#include "morsel/core/field/link_changes.h"
#include "morsel/core/field/scalar_field.h"

namespace morsel::core {

/// From its link. O(degree).
inline VertexKind vertex_kind(const ScalarField& field, Index v) {
  const auto rank = field.ranks();
  const Index center = rank[v];
  return vertex_kind(field.mesh(), v, [&](Index u) { return rank[u] < center; });
}

/// The same where the changes in its link are counted already; it is walked only where they are cut off.
inline VertexKind vertex_kind(const ScalarField& field, Index v, LinkChanges changes) {
  return changes.is_cut_off() ? vertex_kind(field, v) : changes.kind();
}

/// Minima, saddle vertices and maxima. O(n), parallel.
std::size_t critical_count(const ScalarField& field);

}  // namespace morsel::core
