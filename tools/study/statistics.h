#pragma once
/// What several trials say of a quantity.

#include <cstddef>
#include <optional>
#include <span>

namespace morsel::tools {

/// Of all intervals.
inline constexpr double kConfidence = 0.95;

/// A mean and how far it can be trusted.
struct Estimate {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  ///< the sample's standard deviation (with count − 1)
  /// The mean lies within ± this of the sample's with a confidence of 95 %, were the values normally
  /// distributed: Student's t with count − 1 degrees of freedom. None for fewer than two values.
  std::optional<double> half_width;
};

/// Of nothing: a count of 0.
Estimate estimate(std::span<const double> values);

}  // namespace morsel::tools
