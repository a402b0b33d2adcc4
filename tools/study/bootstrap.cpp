#include "morsel/tools/study/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/study/random_stream.h"

namespace morsel::tools {
namespace {

constexpr std::size_t kResamplesOfChunk = 64;

}  // namespace

Bootstrap::Bootstrap(std::size_t values, std::size_t resamples, std::uint64_t seed)
    : count_(values), resamples_(resamples) {
  if (resamples < kFewestResamples || resamples > kMostResamples)
    throw core::InvalidArgument("an interval needs at least " + std::to_string(kFewestResamples) +
                                " resamples and at most " + std::to_string(kMostResamples) + ", not " +
                                std::to_string(resamples));
  if (values < 2) return;
  drawn_.resize(values * resamples);
  core::parallel_for(0, resamples, kResamplesOfChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      RandomStream random(seed, RandomUse::bootstrap, {r});
      for (std::size_t i = 0; i < values; ++i)
        drawn_[r * values + i] = static_cast<std::uint32_t>(random.below(values));
    }
  });
}

std::optional<Interval> Bootstrap::of_mean(std::span<const double> values) const {
  if (count_ < 2) return std::nullopt;
  std::vector<double> means(resamples_);
  core::parallel_for(0, resamples_, kResamplesOfChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      double sum = 0;
      for (std::size_t i = 0; i < count_; ++i) sum += values[drawn_[r * count_ + i]];
      means[r] = sum / static_cast<double>(count_);
    }
  });
  std::ranges::sort(means);
  const double outside = (1 - kConfidence) / 2 * static_cast<double>(resamples_ + 1);
  const auto below = static_cast<std::size_t>(std::max(1.0, std::floor(outside)));  // as many as are left out
  return Interval{means[below - 1], means[resamples_ - below]};
}

}  // namespace morsel::tools
