#pragma once
/// A thread's stop token, for code that is given no Progress.

#include <stop_token>

namespace morsel::core {

/// While it lives, the token replaces the thread's earlier one for throw_if_stopped() and for the parallel
/// loops that this thread starts, whichever threads run them. The program sets one for everything it does;
/// without one, only Progress stops a computation.
class StopScope {
 public:
  explicit StopScope(std::stop_token token);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  std::stop_token token_;
  const std::stop_token* before_;
};

/// Throws Cancelled if a stop was requested with this thread's token. For loops that may take long; costs
/// nanoseconds.
void throw_if_stopped();

namespace detail {
/// This thread's token; null if none is set.
const std::stop_token*& current_stop();
}  // namespace detail

}  // namespace morsel::core
