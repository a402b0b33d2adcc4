#pragma once
/// New values for a field, with ties in the field's order.

#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::morse {

/// The field of `values` on the mesh of `before`, equal values in the order that their vertices had there. So
/// a method that does not change a plateau keeps its order too (the order of plateaus after cancellation must
/// not be lost), and negating a field before or after such a method gives the same field. Throws as
/// ScalarField does. O(n log n), parallel.
core::ScalarField keep_order(const core::ScalarField& before, std::vector<double> values);

}  // namespace morsel::morse
