#pragma once
/// Confidence intervals of means that assume no distribution.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "morsel/tools/study/statistics.h"

namespace morsel::tools {

/// Of which an interval is taken.
inline constexpr std::size_t kFewestResamples = 100;
inline constexpr std::size_t kMostResamples = 100'000;

struct Interval {
  double low = 0;
  double high = 0;
};

/// The percentile bootstrap (Efron 1979, "Bootstrap methods: another look at the jackknife"; Efron,
/// Tibshirani 1993, section 13.3): resamples of n values, n of them with replacement, and the middle 95 %
/// (kConfidence) of their means. All quantities of a Bootstrap have the same resamples, so that intervals of
/// differences are those of pairs. With few values intervals are too narrow: of 10 they hold some 90 %
/// instead of 95 %.
class Bootstrap {
 public:
  /// Throws InvalidArgument for fewer than 100 resamples or more than 100,000. The r-th depends on `seed`,
  /// r and `values` alone. Keeps 4 bytes for each value and resample.
  Bootstrap(std::size_t values, std::size_t resamples, std::uint64_t seed);

  /// Of the mean of as many values as it was made for; none of fewer than two. O(values · resamples),
  /// parallel, the same bits for every number of threads.
  std::optional<Interval> of_mean(std::span<const double> values) const;

 private:
  std::size_t count_;
  std::size_t resamples_;
  std::vector<std::uint32_t> drawn_;  // resample after resample
};

}  // namespace morsel::tools
