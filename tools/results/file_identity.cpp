#include "morsel/tools/results/file_identity.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <charconv>

namespace morsel::tools {
namespace {

std::int64_t nanoseconds(const struct statx_timestamp& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::optional<FileIdentity> identity(int folder, const char* name, int flags) {
  struct statx status {};
  if (::statx(folder, name, flags, STATX_BASIC_STATS | STATX_BTIME, &status) != 0) return std::nullopt;
  const bool has_time = (status.stx_mask & STATX_BTIME) != 0;
  return FileIdentity{status.stx_ino, has_time ? nanoseconds(status.stx_btime) : 0, status.stx_size,
                      nanoseconds(status.stx_mtime), S_ISREG(status.stx_mode)};
}

/// Takes a number and the comma before it, if it is not the first, off the text.
template <class Int>
bool take(std::string_view& text, Int& number, bool is_first = false) {
  if (!is_first) {
    if (!text.starts_with(',')) return false;
    text.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

bool FileIdentity::is_that_of(const FileIdentity& other) const {
  return (inode == other.inode && made == other.made) || (bytes == other.bytes && changed == other.changed);
}

std::string FileIdentity::text() const {
  return std::to_string(inode) + "," + std::to_string(made) + "," + std::to_string(bytes) + "," +
         std::to_string(changed);
}

std::optional<FileIdentity> FileIdentity::from_text(std::string_view text) {
  FileIdentity read;
  if (!take(text, read.inode, true) || !take(text, read.made) || !take(text, read.bytes) ||
      !take(text, read.changed) || !text.empty())
    return std::nullopt;
  return read;
}

std::optional<FileIdentity> identity_of(int file) { return identity(file, "", AT_EMPTY_PATH); }

std::optional<FileIdentity> identity_of(int folder, const std::string& name) {
  return identity(folder, name.c_str(), AT_SYMLINK_NOFOLLOW);
}

}  // namespace morsel::tools
