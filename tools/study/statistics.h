#pragma once
/// The mean of a quantity over several trials, with its confidence.

#include <cstddef>
#include <optional>
#include <span>

namespace morsel::tools {

/// The confidence of all intervals.
inline constexpr double kConfidence = 0.95;

/// A mean and its confidence interval.
struct Estimate {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  ///< the sample's standard deviation (with count − 1)
  /// The mean lies within ± this of the sample's with a confidence of 95 %, if the values are normally
  /// distributed: Student's t with count − 1 degrees of freedom. None for fewer than two values.
  std::optional<double> half_width;
};

/// Without values: a count of 0.
Estimate estimate(std::span<const double> values);

}  // namespace morsel::tools
