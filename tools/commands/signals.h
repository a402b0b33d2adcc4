#pragma once
/// Ctrl-C, termination and other signals, turned into an orderly stop.

#include <csignal>
#include <stop_token>

namespace morsel::tools {

/// While it lives, signals end the program in order, without a thread of their own:
/// - SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGXCPU, SIGIO, SIGPWR:
///   the first requests a stop, so that the computation unwinds; a second one (but for SIGPIPE) ends the
///   program at once. They are passed to the thread that made the watch, so that its waiting for a pipe ends.
/// - SIGXFSZ is ignored: the write fails with its reason.
/// - SIGQUIT and those of a crash act at once, as always; named temporary files are removed before. If memory
///   had run out before a crash, the program ends with the exit code and the sentence for that.
/// What was ignored when the program began (nohup) stays ignored; what somebody else handles is left to him.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  /// The signal that requested the stop, 0 if none did. Async-signal-safe.
  static int received();

 private:
  std::stop_source stop_;
};

/// The exit code after an orderly stop: 130 of SIGINT, 143 of SIGTERM. Other signals end the process here as
/// they do by themselves, so that whoever waits for it sees the signal.
int end_by(int signal);

}  // namespace morsel::tools
