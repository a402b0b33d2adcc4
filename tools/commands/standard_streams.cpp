#include "morsel/tools/commands/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace morsel::tools {

void occupy_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number, which is this one. With O_PATH it can neither be read nor written, and
    // /dev/stdout is not a file that takes a result; / is there without /dev, too.
    if (::open("/", O_PATH) < 0)
      throw std::system_error(errno, std::generic_category(), "cannot open a standard stream");
  }
}

}  // namespace morsel::tools
