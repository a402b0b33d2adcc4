#pragma once
/// Independent tasks of one run, in parallel.

#include <cstddef>
#include <functional>
#include <string_view>

#include "morsel/core/parallel/progress.h"

namespace morsel::tools {

/// Runs task(i, silent) for each i < count, in parallel and in any order. Their progress is reported as that
/// of `step`; `silent` stops a task with the others and reports nothing. Of several errors that of the first
/// task is thrown: tasks before a failed one are always run.
void run_tasks(std::size_t count, std::string_view step,
               const std::function<void(std::size_t i, const core::Progress& silent)>& task,
               const core::Progress& progress);

}  // namespace morsel::tools
