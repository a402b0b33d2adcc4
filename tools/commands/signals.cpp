#include "morsel/tools/commands/signals.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>

#include "morsel/core/io/temporary_file.h"
#include "morsel/tools/commands/failure.h"

namespace morsel::tools {
namespace {

constexpr std::array kOrderly = {SIGHUP,  SIGINT,  SIGTERM, SIGPIPE, SIGALRM, SIGVTALRM,
                                 SIGPROF, SIGUSR1, SIGUSR2, SIGXCPU, SIGIO,   SIGPWR};
constexpr std::array kAtOnce = {SIGQUIT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP};

std::atomic<int> received_signal{0};
std::atomic<std::stop_source*> stop_requests{nullptr};
std::atomic<pthread_t> watching{};  // the thread that a signal is to interrupt, while there are stop requests

void act_by_default(int signal) {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  raise(signal);
}

// request_stop() takes a lock that only the making and unmaking of callbacks holds: who does that blocks
// signals meanwhile.
void stop_in_order(int signal) {
  const int error = errno;
  int none = 0;
  if (stop_requests.load() != nullptr && pthread_equal(pthread_self(), watching) == 0) {
    pthread_kill(watching, signal);  // which may wait for a pipe
  } else if (received_signal.compare_exchange_strong(none, signal)) {
    if (std::stop_source* stop = stop_requests.load()) stop->request_stop();
  } else if (signal != SIGPIPE) {  // of which every further write to a closed pipe makes one
    core::unlink_temporary_files();
    act_by_default(signal);
  }
  errno = error;
}

void end_at_once(int signal) {
  core::unlink_temporary_files();
  if (signal != SIGQUIT && memory_has_run_out()) end_out_of_memory();
  act_by_default(signal);
}

/// Unless the signal is ignored or handled by somebody else.
void handle(int signal, void (*handler)(int)) {
  struct sigaction before {};
  if (sigaction(signal, nullptr, &before) != 0 || (before.sa_flags & SA_SIGINFO) != 0 ||
      before.sa_handler != SIG_DFL)
    return;
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: waiting for a pipe ends
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_ONSTACK;
  sigaction(signal, &action, nullptr);
}

/// A stack for the handlers, should the main thread's own be used up.
void use_a_stack_of_its_own() {
  alignas(16) static std::array<char, 1 << 16> memory;
  stack_t stack{};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  sigaltstack(&stack, nullptr);
}

}  // namespace

SignalWatch::SignalWatch() {
  watching = pthread_self();
  stop_requests = &stop_;
  use_a_stack_of_its_own();
  for (const int signal : kOrderly) handle(signal, stop_in_order);
  for (const int signal : kAtOnce) handle(signal, end_at_once);
  handle(SIGXFSZ, SIG_IGN);
}

SignalWatch::~SignalWatch() { stop_requests = nullptr; }

int SignalWatch::received() { return received_signal.load(); }

int end_by(int signal) {
  if (signal != SIGINT && signal != SIGTERM) {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);  // after an orderly stop there is nothing to learn from a core
    act_by_default(signal);
  }
  return 128 + signal;
}

}  // namespace morsel::tools
