#pragma once
/// Many child processes, a few at a time.

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/batch/child.h"

namespace morsel::tools::batch {

/// The child processes and the callback at their end; i is in [0, count).
struct ChildTasks {
  std::size_t count = 0;
  std::function<std::vector<std::string>(std::size_t i)>
      begin;  ///< the words to start child i with (child.h)
  std::function<void(std::size_t i, const ChildEnd& end)> end;
};

/// Runs the children in order, at most `jobs` (≥ 1) at a time, each within the limits, and calls `end` in the
/// order in which they end; all by the calling thread, which sleeps meanwhile. Throws Cancelled when a stop
/// is requested by either token (only `stop` wakes it at once), and what the two functions throw; all
/// children have ended then.
void run_children(const ChildTasks& tasks, std::size_t jobs, const ChildLimits& limits,
                  const std::stop_token& stop = {}, const core::Progress& progress = {});

}  // namespace morsel::tools::batch
