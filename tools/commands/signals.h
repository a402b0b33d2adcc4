#pragma once
/// Ctrl-C and termination, turned into an orderly stop.

#include <stop_token>
#include <thread>

namespace morsel::tools {

/// While it lives, the first SIGINT or SIGTERM requests a stop, so that the computation unwinds and leaves no
/// half-written file; a second one ends the program at once. Made before any other thread, which then
/// inherits the signal mask.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  /// The signal that came, 0 if none did.
  static int received();

 private:
  std::stop_source stop_;
  std::thread watcher_;
};

}  // namespace morsel::tools
