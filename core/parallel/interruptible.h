#pragma once
/// Long loops and sorts that can be stopped.

#include <functional>
#include <utility>

#include "morsel/core/parallel/stop.h"

namespace morsel::core {

/// throw_if_stopped() every 1,024 calls: for the steps of a loop that take nanoseconds.
inline void throw_if_stopped_at_times() {
  thread_local unsigned calls = 0;
  if ((++calls & 1023) == 0) throw_if_stopped();
}

/// `less` for a sort of many elements, which throws Cancelled if a stop of this thread was requested
/// (stop.h).
template <class Less = std::less<>>
auto interruptible(Less less = {}) {
  return [less = std::move(less)](const auto& a, const auto& b) {
    throw_if_stopped_at_times();
    return less(a, b);
  };
}

}  // namespace morsel::core
