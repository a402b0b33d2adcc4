#pragma once
/// Plateaus: ranks of equal value. For the module's own use.

#include "morsel/core/field/scalar_field.h"

namespace morsel::persistence::detail {

using core::Index;

/// The plateau of one value: the ranks [first, last) of all its vertices, connected or not.
struct Level {
  Index first;
  Index last;
  bool holds(Index rank) const { return first <= rank && rank < last; }
};

/// The level that holds `rank`. O(log k) in the number of its vertices.
Level level_of(const core::ScalarField& field, Index rank);

}  // namespace morsel::persistence::detail
