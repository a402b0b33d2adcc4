#pragma once
/// The paper's Listing 1 written down plainly: the oracle of the fast filter, and the baseline of its
/// benchmark.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::test {

struct SalientReferenceOptions {
  int iterations = 10;
  double sigma = 1;
  double support = 2;
  std::optional<double> sigma_s;                     ///< none: the largest difference in each neighbourhood
  std::vector<double> weights = {};                  ///< how often each vertex counts; empty: once
  const core::TriangleMesh* connected_by = nullptr;  ///< only neighbours that its edges in the ball reach
};

/// One vertex of one iteration: a kd-tree radius search, two exp a pair. For one thread.
class SalientListing {
 public:
  SalientListing(std::span<const core::Point> positions, const SalientReferenceOptions& options);
  ~SalientListing();
  SalientListing(const SalientListing&) = delete;
  SalientListing& operator=(const SalientListing&) = delete;

  /// S(v); `pairs`, if given, is raised by the number of neighbours, v included.
  double saliency(std::span<const double> values, core::Index v, std::size_t* pairs = nullptr);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

/// The values after the iterations; `saliency` gets the last S.
std::vector<double> salient_reference(std::span<const core::Point> positions, std::vector<double> values,
                                      const SalientReferenceOptions& options,
                                      std::vector<double>* saliency = nullptr);

}  // namespace morsel::test
