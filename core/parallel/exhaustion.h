#pragma once
/// Distinguishes exhausted system resources from other failures of a system call.

#include <string>

namespace morsel::core {

/// Throws std::system_error if a system's call failed with this error number because descriptors, memory,
/// processes or threads ran out (EMFILE, ENFILE, ENOMEM, EAGAIN), which is not the file's fault. `what`
/// begins the message.
void throw_if_exhausted(int error, const std::string& what);

/// For a failed call that reads a file: throws as above, or else BadInput with `what` and the system's
/// reason.
[[noreturn]] void fail_to_read(int error, const std::string& what);

}  // namespace morsel::core
