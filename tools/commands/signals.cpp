#include "morsel/tools/commands/signals.h"

#include <pthread.h>

#include <atomic>
#include <csignal>

namespace morsel::tools {
namespace {

std::atomic<int> received_signal{0};

sigset_t watched() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGUSR2);  // ends the watch
  return set;
}

}  // namespace

SignalWatch::SignalWatch() {
  const sigset_t set = watched();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::thread([this, set] {
    int signal = 0;
    while (sigwait(&set, &signal) == 0 && signal != SIGUSR2) {
      if (received_signal.exchange(signal) != 0) {
        std::signal(signal, SIG_DFL);
        pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
        raise(signal);
      }
      stop_.request_stop();
    }
  });
}

SignalWatch::~SignalWatch() {
  pthread_kill(watcher_.native_handle(), SIGUSR2);
  watcher_.join();
}

int SignalWatch::received() { return received_signal.load(); }

}  // namespace morsel::tools
