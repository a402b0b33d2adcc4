#include "morsel/tools/batch/child.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "morsel/tools/batch/signals_blocked.h"

namespace morsel::tools::batch {
namespace {

constexpr std::size_t kKeptText = 2000;  // bytes of standard error: its end, where the reason is

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// For standard input and output: /dev/null or, in a system without it, an empty file in memory, at the end
/// of which the child reads and writes.
int open_null() {
  const int null = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  return null >= 0 || errno != ENOENT ? null : ::memfd_create("null", MFD_CLOEXEC);
}

/// All that happens between fork() and exec: calls that are allowed there, in a program with threads.
[[noreturn]] void become(char* const* words, const ChildLimits& limits, pid_t parent, int null, int output,
                         const sigset_t& mask) {
  // This program's handlers are not for the child; execv() resets them, but leaves the mask.
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) {
      action = {};
      action.sa_handler = SIG_DFL;
      ::sigaction(signal, &action, nullptr);
    }
  }
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it ended before the call above
  ::dup2(null, STDIN_FILENO);
  ::dup2(null, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (limits.memory_mib > 0) {
    const rlim_t bytes = static_cast<rlim_t>(limits.memory_mib) << 20;
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_DATA, &limit);
  }
  ::execv(words[0], words + 1);
  constexpr char kMessage[] = "the program cannot be run";
  static_cast<void>(::write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1));
  ::_exit(127);
}

/// Lines become one, without the program's name before them.
std::string on_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  constexpr std::string_view kName = "morsel: ";
  if (text.starts_with(kName)) text.erase(0, kName.size());
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "; ";
    else
      line += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return line;
}

}  // namespace

Child::Child(const std::vector<std::string>& words, const ChildLimits& limits) : start_(Clock::now()) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (limits.seconds > 0)
    deadline_ =
        start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.seconds));

  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) fail("cannot start a process");
  output_ = pipe[0];
  const int null = open_null();
  const pid_t parent = ::getpid();
  int error = errno;
  if (null >= 0) {
    const SignalsBlocked blocked;  // or a handler would act in both processes
    process_ = ::fork();
    if (process_ == 0) become(arguments.data(), limits, parent, null, pipe[1], blocked.before());
    error = errno;
  }
  if (null >= 0) ::close(null);
  ::close(pipe[1]);
  if (process_ < 0) {
    ::close(output_);
    errno = error;
    fail("cannot start a process");
  }
  ::setpgid(process_, process_);  // by whoever is first: it must be done before the group is killed
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (process_ > 0) {
    kill_group();
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  if (output_ >= 0) ::close(output_);
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      output_(std::exchange(other.output_, -1)),
      start_(other.start_),
      deadline_(other.deadline_),
      killed_(other.killed_),
      text_(std::move(other.text_)) {}

void Child::kill_group() const {
  if (::kill(-process_, SIGKILL) != 0) ::kill(process_, SIGKILL);
}

void Child::kill_late() {
  if (killed_ || !deadline_ || Clock::now() < *deadline_) return;
  killed_ = true;
  kill_group();
}

std::optional<ChildEnd> Child::read() {
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t size = ::read(output_, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return std::nullopt;
    if (size < 0) kill_group();    // its end could not be read
    if (size <= 0) return wait();  // the other end is closed
    text_.append(buffer.data(), static_cast<std::size_t>(size));
    if (text_.size() > kKeptText) text_.erase(0, text_.size() - kKeptText);
  }
}

ChildEnd Child::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  ChildEnd end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  end.timed_out = killed_ && end.signal == SIGKILL;
  end.message = on_one_line(std::move(text_));
  end.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return end;
}

}  // namespace morsel::tools::batch
