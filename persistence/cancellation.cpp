#include "morsel/persistence/cancellation.h"

#include <utility>

#include "morsel/core/error.h"
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
  const Diagram& diagram = canceller.diagram();
  progress.update("cancellation", 0.5);
  const auto largest = [&](std::size_t cancelled) {
    return cancelled == 0 ? 0 : diagram.pairs[cancelled - 1].persistence();
  };
  if (options.count) {
    const detail::CountSearch search(canceller, *options.count, progress);
    progress.update("cancellation", 1);
    const std::size_t cancelled = search.cancelled_pairs();
    return {search.field(), cancelled, largest(cancelled), search.reached(), search.note()};
  }
  const std::size_t cancelled = diagram.finite_count - diagram.count_above(threshold);
  CancellationResult result{canceller.run(cancelled), cancelled, largest(cancelled), 0, {}};
  result.reached_count = detail::critical_count(result.field);
  progress.update("cancellation", 1);
  return result;
}

}  // namespace morsel::persistence
