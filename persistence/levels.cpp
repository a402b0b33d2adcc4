#include "morsel/persistence/levels.h"

#include <algorithm>

namespace morsel::persistence::detail {

Level level_of(const core::ScalarField& field, Index rank) {
  const auto order = field.order();
  const double value = field.value(order[rank]);
  const auto is_equal = [&](Index r) { return field.value(order[r]) == value; };
  // Steps that double, then halve: most plateau ranks have one vertex.
  const auto n = static_cast<Index>(order.size());
  Index inside = rank;
  Index step = 1;
  for (; step <= inside && is_equal(inside - step); step *= 2) inside -= step;
  for (; step > 0; step /= 2)
    if (step <= inside && is_equal(inside - step)) inside -= step;
  const Index first = inside;
  inside = rank;
  step = 1;
  for (; step < n - inside && is_equal(inside + step); step *= 2) inside += step;
  for (; step > 0; step /= 2)
    if (step < n - inside && is_equal(inside + step)) inside += step;
  return {first, inside + 1};
}

}  // namespace morsel::persistence::detail
