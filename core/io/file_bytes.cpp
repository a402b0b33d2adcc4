#include "morsel/core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "morsel/core/parallel/exhaustion.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

[[noreturn]] void fail(const std::string& name, int error) {
  fail_to_read(error, "cannot read \"" + name + "\"");
}

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path, const std::string& name) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) fail(name, errno);
  const struct Closer {
    int file;
    ~Closer() { ::close(file); }
  } closer{file};
  struct stat status {};
  if (::fstat(file, &status) != 0) fail(name, errno);
  if (S_ISDIR(status.st_mode)) fail_reading(name, "it is a directory");
  if (!S_ISREG(status.st_mode)) fail_reading(name, "it is not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  bytes_ = std::make_unique_for_overwrite<char[]>(size);
  while (size_ < size) {
    const ssize_t got = ::read(file, bytes_.get() + size_, std::min<std::size_t>(size - size_, 1 << 28));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(name, errno);
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
}

}  // namespace morsel::core
