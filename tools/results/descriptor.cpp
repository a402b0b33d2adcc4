#include "morsel/tools/results/descriptor.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

bool is_link(int folder, const char* name) {
  struct stat status {};
  return ::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
}

/// Removes all that is in the folder, which is closed then.
bool remove_contents(int folder, dev_t device) noexcept {
  DIR* entries = ::fdopendir(folder);
  if (entries == nullptr) {
    ::close(folder);
    return false;
  }
  bool removed = true;
  while (const dirent* entry = ::readdir(entries)) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == "..") continue;
    if (::unlinkat(folder, entry->d_name, 0) == 0) continue;
    const int inner = ::openat(folder, entry->d_name, kFolder);
    struct stat status {};
    if (inner < 0) {
      removed = false;
    } else if (::fstat(inner, &status) != 0 || status.st_dev != device) {
      ::close(inner);
      removed = false;
    } else {
      removed =
          remove_contents(inner, device) && ::unlinkat(folder, entry->d_name, AT_REMOVEDIR) == 0 && removed;
    }
  }
  ::closedir(entries);
  return removed;
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

void fail_to_write(const fs::path& path, int error) {
  throw core::WriteFailed("cannot write " + path.string() + ": " + std::generic_category().message(error));
}

Descriptor open_below(int root, const fs::path& relative, Missing missing, const fs::path& shown) {
  Descriptor folder(::openat(root, ".", kFolder));
  if (!folder.is_open()) fail_to_write(shown, errno);
  fs::path path = shown;
  for (const fs::path& part : relative) {
    path /= part;
    Descriptor next(::openat(folder.number(), part.c_str(), kFolder));
    if (!next.is_open() && errno == ENOENT && missing == Missing::make) {
      const bool is_made = ::mkdirat(folder.number(), part.c_str(), 0777) == 0;
      if (!is_made && errno != EEXIST) fail_to_write(path, errno);
      next = Descriptor(::openat(folder.number(), part.c_str(), kFolder));
      if (is_made && !next.is_open()) {
        const int error = errno;
        ::unlinkat(folder.number(), part.c_str(), AT_REMOVEDIR);
        errno = error;
      }
    }
    if (!next.is_open()) {
      const int error = errno;
      if (error == ENOENT && missing == Missing::tell) return next;
      if (is_link(folder.number(), part.c_str()))
        throw core::WriteFailed("cannot write into " + path.string() +
                                ": it is a symbolic link, and none is followed in a folder of results");
      fail_to_write(path, error);
    }
    folder = std::move(next);
  }
  return folder;
}

bool remove_tree(int folder, const std::string& name) noexcept {
  if (::unlinkat(folder, name.c_str(), 0) == 0 || errno == ENOENT) return true;
  const int inner = ::openat(folder, name.c_str(), kFolder);
  struct stat status {};
  struct stat around {};
  if (inner < 0) return false;
  if (::fstat(inner, &status) != 0 || ::fstat(folder, &around) != 0 || status.st_dev != around.st_dev) {
    ::close(inner);
    return false;
  }
  return remove_contents(inner, around.st_dev) && ::unlinkat(folder, name.c_str(), AT_REMOVEDIR) == 0;
}

}  // namespace morsel::tools
