#include "morsel/persistence/cancellation.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/field/classification.h"
#include "morsel/persistence/canceller.h"
#include "morsel/persistence/count_search.h"

namespace morsel::persistence {

CancellationResult cancel(const core::ScalarField& f, const CancellationOptions& options,
                          const core::Progress& progress) {
  const double threshold = options.threshold.on(f);
  if (options.count == std::size_t{0})
    throw core::InvalidArgument("the number of critical points to cancel down to must be at least 1, not 0");
  progress.update("cancellation", 0);
  const detail::Canceller canceller(f, progress);
  progress.update("cancellation", 0.5);
  if (options.count) {
    const detail::CountSearch search(canceller, *options.count, progress);
    progress.update("cancellation", 1);
    const std::span<const PersistencePair> pairs = search.cancelled();
    return {search.field(),   pairs.size(),  search.largest_cancelled(),
            search.reached(), search.note(), {pairs.begin(), pairs.end()}};
  }
  std::vector<PersistencePair> staying;
  double largest = 0;
  for (const PersistencePair& pair : canceller.diagram().finite_pairs())
    if (pair.persistence() > threshold)
      staying.push_back(pair);
    else
      largest = std::max(largest, pair.persistence());
  const std::size_t cancelled = canceller.diagram().finite_count - staying.size();
  CancellationResult result{canceller.run(staying), cancelled, largest, 0, {}};
  result.reached_count = core::critical_count(result.field);
  progress.update("cancellation", 1);
  return result;
}

}  // namespace morsel::persistence
