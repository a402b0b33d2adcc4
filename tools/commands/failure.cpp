#include "morsel/tools/commands/failure.h"

#include <cxxabi.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <ios>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/io/temporary_file.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/signals.h"

namespace morsel::tools {
namespace {

constexpr const char* kOutOfMemorySentence = "out of memory";
constexpr const char* kTooManyThreads =
    "; the number of processes and threads is limited (ulimit -u, or the container): fewer --threads or "
    "--jobs "
    "would do";

std::atomic<bool> new_has_failed{false};

/// What would help if a system's call failed because something ran out; null if it failed for another reason.
const char* help_for(int error) {
  switch (error) {
    case EAGAIN:
      return kTooManyThreads;
    case EMFILE:
      return "; the number of open files is limited (ulimit -n)";
    case ENFILE:
      return "; the system's limit of open files is reached";
    case ENOMEM:
      return "; the system has no memory left for it";
    default:
      return nullptr;
  }
}

int exit_code(core::ErrorKind kind) {
  switch (kind) {
    case core::ErrorKind::invalid_argument:
      return kWrongUsage;
    case core::ErrorKind::write_failed:
      return kWriteFailed;
    case core::ErrorKind::bad_input:
    case core::ErrorKind::cancelled:
      break;
  }
  return kBadInput;
}

/// A text that may hold parts of files and names: control characters are escaped or, without memory for that,
/// replaced.
class Escaped {
 public:
  explicit Escaped(const char* text) noexcept {
    try {
      escaped_ = core::printable(text);
    } catch (...) {
      for (std::size_t i = 0; i + 1 < replaced_.size() && text[i] != 0; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        replaced_[i] = byte < 0x20 || byte >= 0x7f ? '?' : text[i];
      }
    }
  }
  const char* text() const { return escaped_.empty() ? replaced_.data() : escaped_.c_str(); }

 private:
  std::string escaped_;
  std::array<char, 1024> replaced_{};  // ends with 0
};

int tell_defect(const char* what) {
  tell("this is a defect of the program, please report it: ", Escaped(what).text());
  return kBadInput;
}

/// Whether the system ran short of something; then that is told, with what helps.
bool tell_shortage(const std::system_error& error) {
  const bool of_system =
      error.code().category() == std::generic_category() || error.code().category() == std::system_category();
  const char* help = of_system ? help_for(error.code().value()) : nullptr;
  if (help != nullptr) tell(Escaped(error.what()).text(), help);
  return help != nullptr;
}

int tell_handled() {
  try {
    throw;
  } catch (const core::Error& error) {
    tell(Escaped(error.what()).text());
    return exit_code(error.kind());
  } catch (const std::bad_alloc&) {
    tell(kOutOfMemorySentence);
    return kOutOfMemory;
  } catch (const std::length_error&) {  // of a container that was asked for more than memory can be
    tell(kOutOfMemorySentence);
    return kOutOfMemory;
  } catch (const std::ios_base::failure&) {  // FileWriter's streams throw WriteFailed
    tell("cannot write to standard output");
    return kWriteFailed;
  } catch (const std::filesystem::filesystem_error& error) {
    if (tell_shortage(error)) return kOutOfMemory;
    tell(Escaped(error.what()).text());
    return kWriteFailed;
  } catch (const std::system_error& error) {
    return tell_shortage(error) ? kOutOfMemory : tell_defect(error.what());
  } catch (const std::runtime_error& error) {
    // How oneTBB says that it cannot make a thread.
    if (!std::string_view(error.what()).starts_with("pthread_create")) return tell_defect(error.what());
    tell(Escaped(error.what()).text(), kTooManyThreads);
    return kOutOfMemory;
  } catch (const std::exception& error) {
    return tell_defect(error.what());
  } catch (...) {
    return tell_defect("an exception of no known kind");
  }
}

/// Of exceptions that nobody can handle: in the libraries' static initialisation, in functions that may not
/// throw.
[[noreturn]] void end_by_terminate() noexcept {
  static std::atomic<bool> is_ending{false};
  while (is_ending.exchange(true)) ::pause();  // another thread tells it
  core::unlink_temporary_files();
  if (abi::__cxa_current_exception_type() == nullptr) {
    if (memory_has_run_out()) end_out_of_memory();
    ::_exit(tell_defect("std::terminate was called"));
  }
  ::_exit(tell_failure());
}

[[noreturn]] void note_that_new_failed() {
  new_has_failed = true;
  throw std::bad_alloc();
}

constexpr std::array kCrashes = {SIGSEGV, SIGBUS, SIGABRT};

/// Some libraries do not check in their static initialisation what malloc() returns (pixman, which cairo
/// draws with). No input has been read then: nothing else that differs from run to run can be the cause.
void end_at_start(int) {
  tell("a library cannot be started: out of memory, as it seems");
  ::_exit(kOutOfMemory);
}

__attribute__((no_sanitize("address", "thread", "undefined"))) void watch_from_the_beginning() {
  std::set_terminate(end_by_terminate);
  std::set_new_handler(note_that_new_failed);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have not begun yet
  for (const int signal : kCrashes) static_cast<void>(std::signal(signal, end_at_start));
#endif
}

// Before the static initialisation of any library, which may find no memory.
__attribute__((section(".preinit_array"), used)) void (*const before_all)() = watch_from_the_beginning;

}  // namespace

void tell(const char* sentence, const char* rest) noexcept {
  constexpr std::string_view kName = "morsel: ";
  const auto part = [](const char* text, std::size_t size) { return iovec{const_cast<char*>(text), size}; };
  const std::array parts = {part(kName.data(), kName.size()), part(sentence, std::strlen(sentence)),
                            part(rest, std::strlen(rest)), part("\n", 1)};
  while (::writev(STDERR_FILENO, parts.data(), static_cast<int>(parts.size())) < 0 && errno == EINTR) {
  }
}

int tell_failure() noexcept {
  if (const int signal = SignalWatch::received(); signal != 0) {
    if (signal != SIGPIPE) tell("interrupted");
    return end_by(signal);
  }
  return tell_handled();
}

void begin_main() noexcept {
  for (const int signal : kCrashes) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
        now.sa_handler == end_at_start)
      static_cast<void>(std::signal(signal, SIG_DFL));
  }
}

bool memory_has_run_out() noexcept {
  if (new_has_failed) return true;
  constexpr std::size_t kProbe = std::size_t{1} << 20;
  void* const memory = ::mmap(nullptr, kProbe, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return true;
  ::munmap(memory, kProbe);
  return false;
}

void end_out_of_memory() noexcept {
  tell(kOutOfMemorySentence);
  ::_exit(kOutOfMemory);
}

}  // namespace morsel::tools
