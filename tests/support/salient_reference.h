#pragma once
/// The paper's Listing 1 written down plainly: the oracle of the fast filter, and the baseline of its
/// benchmark.

#include <optional>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::test {

struct SalientReferenceOptions {
  int iterations = 10;
  double sigma = 1;
  double support = 2;
  std::optional<double> sigma_s;  ///< none: the largest difference in each neighbourhood
};

/// The values after the iterations; `saliency` gets the last S. A kd-tree radius search per vertex and
/// iteration, two exp a pair, one thread.
std::vector<double> salient_reference(std::span<const core::Point> positions, std::vector<double> values,
                                      const SalientReferenceOptions& options,
                                      std::vector<double>* saliency = nullptr);

}  // namespace morsel::test
