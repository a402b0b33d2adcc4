#pragma once
/// A child process within limits, which never outlives this one.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace morsel::tools::batch {

struct ChildLimits {
  double seconds = 0;            ///< of wall-clock time; 0: none
  std::uint64_t memory_mib = 0;  ///< of writable memory of its own (heap, data, stacks; not code); 0: none

  friend bool operator==(const ChildLimits&, const ChildLimits&) = default;
};

/// How a child ended.
struct ChildEnd {
  int exit_code = -1;      ///< −1 if a signal ended it
  int signal = 0;          ///< 0 if none did
  bool timed_out = false;  ///< killed at its time limit
  std::string message;     ///< the end of what it wrote to standard error, on one line
  double seconds = 0;
};

/// A running process in a group of its own, which is killed with the group when the object is destroyed, and
/// by the system when the thread that started it ends in whatever way (Linux). Its standard input and output
/// are /dev/null, or a file in memory where that is missing. Moved, not copied.
class Child {
 public:
  /// `words`: the program's file (not looked for in PATH), its argv[0], its arguments. Throws
  /// std::system_error if no process can be made; a program that cannot be run ends with 127.
  Child(const std::vector<std::string>& words, const ChildLimits& limits);
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;

  using Clock = std::chrono::steady_clock;
  /// Readable when there is output to read() or the child ended.
  int descriptor() const { return output_; }
  /// When kill_late() is to be called.
  std::optional<Clock::time_point> deadline() const { return killed_ ? std::nullopt : deadline_; }
  void kill_late();
  /// Reads the available output, without waiting; returns how the child ended, once it has.
  std::optional<ChildEnd> read();

 private:
  void kill_group() const;
  ChildEnd wait();

  pid_t process_ = -1;  // -1: waited for
  int output_ = -1;
  Clock::time_point start_;
  std::optional<Clock::time_point> deadline_;
  bool killed_ = false;
  std::string text_;
};

}  // namespace morsel::tools::batch
