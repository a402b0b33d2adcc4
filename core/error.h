#pragma once
/// The errors that the library throws. It never prints and never exits.

#include <stdexcept>
#include <string>

namespace morsel::core {

/// Kinds of errors; the program maps each to an exit code.
enum class ErrorKind {
  invalid_argument,  ///< a parameter out of range, an unknown name or key: the caller's mistake (exit code 2)
  bad_input,         ///< a file or mesh or field that is missing, damaged or refused (exit code 3)
  write_failed,      ///< an output could not be written whole (exit code 4)
  cancelled          ///< the caller asked, through Progress, to stop (exit codes 130 and 143)
};

/// Base of every error of the library. `what()` is one clear sentence: what, where, how many, what would
/// help.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

/// A parameter that is out of range, of the wrong form, or unknown.
class InvalidArgument : public Error {
 public:
  explicit InvalidArgument(const std::string& message) : Error(ErrorKind::invalid_argument, message) {}
};

/// A file, mesh or field that cannot be used.
class BadInput : public Error {
 public:
  explicit BadInput(const std::string& message) : Error(ErrorKind::bad_input, message) {}
};

/// A file that could not be written.
class WriteFailed : public Error {
 public:
  explicit WriteFailed(const std::string& message) : Error(ErrorKind::write_failed, message) {}
};

/// Thrown by a computation whose stop was requested.
class Cancelled : public Error {
 public:
  Cancelled() : Error(ErrorKind::cancelled, "cancelled") {}
};

}  // namespace morsel::core
