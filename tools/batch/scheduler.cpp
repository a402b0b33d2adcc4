#include "morsel/tools/batch/scheduler.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <list>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/tools/batch/signals_blocked.h"

namespace morsel::tools::batch {
namespace {

/// A descriptor that becomes readable when a stop is requested.
class StopAlarm {
 public:
  explicit StopAlarm(std::stop_token token) : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    const SignalsBlocked blocked;  // a handler that requests the stop would deadlock
    callback_.emplace(std::move(token), Ring{descriptor_});
  }
  ~StopAlarm() {
    const SignalsBlocked blocked;
    callback_.reset();  // no callback runs after this
    ::close(descriptor_);
  }
  StopAlarm(const StopAlarm&) = delete;
  StopAlarm& operator=(const StopAlarm&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  struct Ring {
    int descriptor;
    void operator()() const {
      const std::uint64_t one = 1;
      static_cast<void>(!::write(descriptor, &one, sizeof(one)));
    }
  };
  int descriptor_;
  std::optional<std::stop_callback<Ring>> callback_;
};

struct Running {
  std::size_t task;
  Child child;
};

/// Milliseconds for poll(), rounded up so that it does not return just before the time.
int wait_time(const std::list<Running>& running) {
  std::optional<Child::Clock::time_point> first;
  for (const Running& one : running)
    if (one.child.deadline() && (!first || *one.child.deadline() < *first)) first = one.child.deadline();
  if (!first) return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(*first - Child::Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000));
}

/// None if the system cannot start a process now. Then a running one is waited for; if none runs, the error
/// is thrown.
std::optional<Child> started(const std::vector<std::string>& words, const ChildLimits& limits,
                             bool is_alone) {
  try {
    return std::optional<Child>(std::in_place, words, limits);
  } catch (const std::system_error&) {
    if (is_alone) throw;
    return std::nullopt;
  }
}

void sleep_until_something_happens(const std::list<Running>& running, const StopAlarm& alarm) {
  std::vector<pollfd> descriptors = {{alarm.descriptor(), POLLIN, 0}};
  for (const Running& one : running) descriptors.push_back({one.child.descriptor(), POLLIN, 0});
  if (::poll(descriptors.data(), descriptors.size(), wait_time(running)) < 0 && errno != EINTR)
    throw std::system_error(errno, std::generic_category(), "poll");
}

}  // namespace

void run_children(const ChildTasks& tasks, std::size_t jobs, const ChildLimits& limits,
                  const std::stop_token& stop, const core::Progress& progress) {
  if (jobs < 1) throw std::logic_error("run_children: no jobs");
  const StopAlarm alarm(stop);
  std::list<Running> running;  // destroyed first: no child is left on return
  std::size_t next = 0;
  std::size_t ended = 0;
  while (ended < tasks.count) {
    if (stop.stop_requested()) throw core::Cancelled();
    progress.update("meshes", static_cast<double>(ended) / static_cast<double>(tasks.count));
    while (next < tasks.count && running.size() < jobs) {
      std::optional<Child> child = started(tasks.begin(next), limits, running.empty());
      if (!child) break;
      running.push_back({next, std::move(*child)});
      ++next;
    }
    sleep_until_something_happens(running, alarm);
    for (auto one = running.begin(); one != running.end();) {
      one->child.kill_late();
      const std::optional<ChildEnd> end = one->child.read();
      if (!end) {
        ++one;
        continue;
      }
      if (stop.stop_requested())
        throw core::Cancelled();  // a child that ended by the same signal has not failed
      const std::size_t task = one->task;
      one = running.erase(one);
      ++ended;
      tasks.end(task, *end);
    }
  }
}

}  // namespace morsel::tools::batch
