#include "morsel/core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "morsel/core/error.h"
#include "morsel/core/parallel/exhaustion.h"

namespace morsel::core {
namespace {

struct Descriptor {
  const int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

/// The size of an open file; of one that could not be opened, errno says why.
std::size_t size_of(const Descriptor& file, const std::string& what) {
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) fail_to_read(errno, what);
  if (S_ISDIR(status.st_mode)) throw BadInput(what + ": it is a directory");
  if (!S_ISREG(status.st_mode)) throw BadInput(what + ": it is not a regular file");
  return static_cast<std::size_t>(status.st_size);
}

/// Without waiting for the other end of a pipe.
int open_to_read(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

}  // namespace

void check_regular_file(const std::filesystem::path& path, const std::string& what) {
  const Descriptor file{open_to_read(path)};
  static_cast<void>(size_of(file, what));
}

FileBytes::FileBytes(const std::filesystem::path& path, const std::string& name, std::size_t most) {
  const std::string what = "cannot read \"" + name + "\"";
  const Descriptor file{open_to_read(path)};
  const std::size_t size = std::min(size_of(file, what), most);
  bytes_ = std::make_unique_for_overwrite<char[]>(size);
  while (size_ < size) {
    const ssize_t got =
        ::read(file.number, bytes_.get() + size_, std::min<std::size_t>(size - size_, 1 << 28));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_read(errno, what);
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
}

}  // namespace morsel::core
