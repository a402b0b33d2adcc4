#pragma once
/// Telling that something of the system's ran out from other reasons why a call fails.

#include <string>

namespace morsel::core {

/// Throws std::system_error if a system's call failed with this error number because descriptors, memory,
/// processes or threads ran out (EMFILE, ENFILE, ENOMEM, EAGAIN): no fault of the file that it was for.
/// `what` begins the message.
void throw_if_exhausted(int error, const std::string& what);

/// Throws what a failed call for reading a file means: the same, or else BadInput, `what` and the system's
/// reason.
[[noreturn]] void fail_to_read(int error, const std::string& what);

}  // namespace morsel::core
