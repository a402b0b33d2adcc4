#pragma once
/// A scope in which no signal handler of this thread runs.

#include <pthread.h>

#include <csignal>

namespace morsel::tools::batch {

/// Blocks all signals of the calling thread while it lives.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

  /// The mask that was there before.
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_{};
};

}  // namespace morsel::tools::batch
