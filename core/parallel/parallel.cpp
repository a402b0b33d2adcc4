#include "morsel/core/parallel/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <stop_token>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"

namespace morsel::core {

int thread_count() {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(allowed);
}

struct ThreadLimit::Control {
  explicit Control(std::size_t threads) : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads < 1)
    throw InvalidArgument("the number of threads must be at least 1, not " + std::to_string(threads));
  control_ = std::make_unique<Control>(static_cast<std::size_t>(threads));
}

ThreadLimit::~ThreadLimit() = default;

void detail::run_in_arena(const std::function<void()>& work) {
  const int threads = thread_count();
  // The arena of the calling thread has as many slots as the machine has processors; one of our own honours a
  // raised limit. Making one for every loop would cost time, and its worker threads would now and then stay
  // asleep.
  if (threads <= tbb::this_task_arena::max_concurrency()) {
    work();
  } else {
    tbb::task_arena(threads).execute(work);
  }
}

void detail::run_chunks(std::size_t chunks, const std::function<void(std::size_t)>& chunk) {
  if (thread_count() == 1 || chunks == 1) {
    for (std::size_t k = 0; k < chunks; ++k) {
      throw_if_stopped();
      chunk(k);
    }
    return;
  }
  const std::stop_token stop = current_stop() != nullptr ? *current_stop() : std::stop_token();
  run_in_arena([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        const StopScope scope(stop);
                        for (std::size_t k = range.begin(); k != range.end(); ++k) {
                          throw_if_stopped();
                          chunk(k);
                        }
                      });
  });
}

}  // namespace morsel::core
