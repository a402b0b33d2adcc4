#pragma once
/// Comparing squares of distances as distances.

namespace morsel::morse {

/// Largest s whose square root, as computed, is at most the radius.
double largest_square(double radius);

}  // namespace morsel::morse
