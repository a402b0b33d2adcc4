#pragma once
/// Comparing numbers in the fuzz targets.

namespace morsel::fuzz {

/// The same bits, or both no number.
bool same_number(double a, double b);

}  // namespace morsel::fuzz
