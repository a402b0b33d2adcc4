#include "morsel/tools/study/tasks.h"

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools {

void run_tasks(std::size_t count, std::string_view step,
               const std::function<void(std::size_t i, const core::Progress& silent)>& task,
               const core::Progress& progress) {
  const std::thread::id caller = std::this_thread::get_id();
  // A task can be cancelled with the others, but only the caller's thread may report progress.
  const core::Progress silent = progress.unreported();
  std::vector<std::exception_ptr> errors(count);
  std::atomic<std::size_t> first_error = count;
  std::atomic<std::size_t> done = 0;
  progress.update(step, 0);
  core::parallel_for(0, count, 1, [&](std::size_t i, std::size_t) {
    if (i > first_error) return;
    try {
      task(i, silent);
    } catch (...) {
      errors[i] = std::current_exception();
      for (std::size_t seen = first_error; i < seen && !first_error.compare_exchange_weak(seen, i);) {
      }
    }
    const std::size_t finished = ++done;
    if (std::this_thread::get_id() == caller && first_error == count)
      progress.update(step, static_cast<double>(finished) / static_cast<double>(count));
  });
  if (first_error < count) std::rethrow_exception(errors[first_error]);
}

}  // namespace morsel::tools
