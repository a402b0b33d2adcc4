#include "morsel/core/io/temporary_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace morsel::core {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".morsel-";
constexpr std::string_view kSuffix = ".tmp";

/// The names in use, where a signal handler can read them: in static memory. Files whose names have no slot
/// are removed later.
struct Slot {
  enum State : int { free, claimed, filled };
  std::atomic<int> state{free};
  std::array<char, PATH_MAX> path;
};
std::array<Slot, 64> slots;

int register_name(const fs::path& path) {
  if (path.native().size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = Slot::free;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::claimed)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.native().size() + 1);
    slots[i].state = Slot::filled;
    return static_cast<int>(i);
  }
  return -1;
}

/// Whether the name is `.morsel-PID-N.tmp`.
bool is_temporary_name(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix) || name.size() < kPrefix.size() + kSuffix.size())
    return false;
  name = name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size());
  const std::size_t dash = name.find('-');
  const auto is_number = [](std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  return dash != std::string_view::npos && is_number(name.substr(0, dash)) &&
         is_number(name.substr(dash + 1));
}

int lock(int file, int how) {
  int result = 0;
  do result = ::flock(file, how);
  while (result != 0 && errno == EINTR);
  return result;
}

/// Removes the entry if it is a temporary file that no process is writing.
void remove_if_left(int folder, const char* name) {
  struct stat found {};
  if (::fstatat(folder, name, &found, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(found.st_mode) ||
      found.st_uid != ::geteuid())
    return;
  constexpr int kFlags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  int file = ::openat(folder, name, O_RDWR | kFlags);  // what locks need over a network
  if (file < 0) file = ::openat(folder, name, O_RDONLY | kFlags);
  if (file < 0) return;
  struct stat opened {};
  if (::fstat(file, &opened) == 0 && opened.st_dev == found.st_dev && opened.st_ino == found.st_ino &&
      lock(file, LOCK_EX | LOCK_NB) == 0)
    static_cast<void>(::unlinkat(folder, name, 0));
  ::close(file);
}

/// Once a folder and process. What cannot be read or removed stays.
void remove_left_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<std::pair<dev_t, ino_t>> visited;
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return;
  {
    const std::lock_guard alone(mutex);
    if (!visited.emplace(status.st_dev, status.st_ino).second) return;
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries.get()))
    if (is_temporary_name(entry->d_name)) remove_if_left(::dirfd(entries.get()), entry->d_name);
}

/// The system's path of an open file, with or without a name.
std::array<char, 40> path_of(int file) {
  std::array<char, 40> path{};
  std::snprintf(path.data(), path.size(), "/proc/self/fd/%d", file);
  return path;
}

int link_as(int file, const fs::path& path) {
  return ::linkat(AT_FDCWD, path_of(file).data(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

}  // namespace

bool is_descriptor_path(const fs::path& path) {
  const std::string text = path.lexically_normal().string();
  return text.starts_with("/dev/fd/") || text.starts_with("/dev/std") || text.starts_with("/proc/");
}

int sync_to_disk(int file) {
  while (::fsync(file) != 0) {
    if (errno == EINVAL || errno == EROFS || errno == ENOTSUP) return 0;
    if (errno != EINTR) return errno;
  }
  return 0;
}

void unlink_temporary_files() noexcept {
  for (Slot& slot : slots)
    if (slot.state == Slot::filled) ::unlink(slot.path.data());
}

int TemporaryFile::open(const fs::path& target) {
  target_ = target;
  folder_ = target.has_parent_path() ? target.parent_path() : fs::path(".");
  remove_left_once(folder_);
#ifdef O_TMPFILE
  file_ = ::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (file_ >= 0) {
    if (::access(path_of(file_).data(), F_OK) == 0) return 0;
    ::close(std::exchange(file_, -1));  // without /proc it could not be given a name
  }
#endif
  return open_named();
}

int TemporaryFile::open_named() {
  for (;;) {
    next_name();
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) {
      const int error = errno;
      forget_name();
      if (error == EEXIST) continue;
      return error;
    }
    static_cast<void>(lock(file_, LOCK_EX));  // without locks nothing is removed as left over
    struct stat status {};
    if (::fstat(file_, &status) != 0 || status.st_nlink > 0) return 0;
    forget_name();  // another process removed it before it was locked
    ::close(std::exchange(file_, -1));
  }
}

void TemporaryFile::next_name() {
  static std::atomic<unsigned> counter{0};
  name_ = folder_ / (std::string(kPrefix) + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
                     std::string(kSuffix));
  slot_ = register_name(name_);
}

void TemporaryFile::forget_name() noexcept {
  name_.clear();
  if (slot_ >= 0) slots[static_cast<std::size_t>(std::exchange(slot_, -1))].state = Slot::free;
}

int TemporaryFile::publish(bool sync) {
  if (sync)
    if (const int error = sync_to_disk(file_); error != 0) return error;
  if (name_.empty()) {
    const int error = link_as(file_, target_);
    if (error == 0) return ::close(std::exchange(file_, -1)) != 0 && errno != EINTR ? errno : 0;
    if (error != EEXIST) return error;
    if (const int failure = link_under_temporary_name(); failure != 0) return failure;
  }
  return rename_to_target(sync);
}

int TemporaryFile::link_under_temporary_name() {
  static_cast<void>(lock(file_, LOCK_EX | LOCK_NB));
  for (;;) {
    next_name();
    const int error = link_as(file_, name_);
    if (error == 0) return 0;
    forget_name();
    if (error != EEXIST) return error;
  }
}

int TemporaryFile::rename_to_target(bool sync) {
  // Opened before anything is replaced, so that running out of descriptors is detected in time. Who may write
  // in a folder need not be allowed to read it.
  const int folder = sync ? ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
  int error = sync && folder < 0 && errno != EACCES ? errno : 0;
  if (error == 0 && ::rename(name_.c_str(), target_.c_str()) != 0) error = errno;
  if (error == 0) {
    forget_name();
    if (folder >= 0) error = sync_to_disk(folder);
    if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR && error == 0) error = errno;
  }
  if (folder >= 0) ::close(folder);
  return error;
}

void TemporaryFile::discard() noexcept {
  if (!name_.empty()) {
    ::unlink(name_.c_str());  // while it is locked
    forget_name();
  }
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

}  // namespace morsel::core
