#pragma once
/// Vertices of equal value. For the module's own use.

#include "morsel/core/field/scalar_field.h"

namespace morsel::persistence::detail {

using core::Index;

/// The ranks [first, last) of all vertices of one value.
struct Level {
  Index first;
  Index last;
  bool holds(Index rank) const { return first <= rank && rank < last; }
};

/// The level of the vertex of that rank. O(log k) in the number of vertices that it has.
Level level_of(const core::ScalarField& field, Index rank);

}  // namespace morsel::persistence::detail
