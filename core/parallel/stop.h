#pragma once
/// A stop that a thread listens to in everything it does, where no Progress is handed down.

#include <stop_token>

namespace morsel::core {

/// While it lives, the parallel loops that this thread starts, whichever threads run them, and
/// throw_if_stopped() in it listen to the token, instead of one given further out. The program sets one for
/// all it does; a library user need not, and then nothing but Progress stops anything.
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

/// Throws Cancelled if a stop was requested that this thread listens to. For loops that may take long; costs
/// nanoseconds.
void throw_if_stopped();

namespace detail {
/// What this thread listens to; null: nothing.
const std::stop_token*& current_stop();
}  // namespace detail

}  // namespace morsel::core
