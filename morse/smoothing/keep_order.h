#pragma once
/// New values for a field whose order decides where they tie.

#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::morse {

/// The field of `values` on the mesh of `before`, equal values in the order that their vertices had there. So
/// a method that leaves a plateau alone leaves its order alone too (cancellation hands over plateaus whose
/// order must not be lost), and negating a field before or after such a method comes to the same. Throws as
/// ScalarField does. O(n log n), parallel.
core::ScalarField keep_order(const core::ScalarField& before, std::vector<double> values);

}  // namespace morsel::morse
