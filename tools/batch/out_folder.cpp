#include "morsel/tools/batch/out_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/tools/export/folder.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, int error) {
  throw core::WriteFailed(what + ": " + std::generic_category().message(error));
}

/// Of a work folder; locked as long as somebody uses it.
fs::path sign(const fs::path& work) { return work / "lock"; }

/// By whoever has the lock of all.
void remove_left_in(const fs::path& all) {
  std::error_code error;
  for (fs::directory_iterator at(all, error), end; !error && at != end; at.increment(error)) {
    const fs::path& work = at->path();
    if (fs::exists(sign(work)))
      if (const std::optional<FileLock> lock = FileLock::take(sign(work), FileLock::Wait::no);
          !lock || !lock->is_held())
        continue;  // somebody's, or nobody can tell
    std::error_code in_use;
    fs::remove_all(work, in_use);
  }
  fs::remove(all, error);  // unless a folder is in it
}

}  // namespace

std::optional<FileLock> FileLock::take(const fs::path& path, Wait wait) {
  make_folder(path.parent_path());
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) fail("cannot write " + path.string(), errno);
  int result = 0;
  do result = ::flock(file, wait == Wait::yes ? LOCK_EX : LOCK_EX | LOCK_NB);
  while (result != 0 && errno == EINTR);
  if (result != 0 && errno == EWOULDBLOCK) {
    ::close(file);
    return std::nullopt;
  }
  return FileLock(file, result == 0);
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)), held_(other.held_) {}

WorkFolder::WorkFolder(const OutFolder& out) : out_(out) {
  const std::optional<FileLock> alone = FileLock::take(out.lock(), FileLock::Wait::yes);
  make_folder(out.work());
  std::string name = (out.work() / "XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) fail("cannot make a folder in " + out.work().string(), errno);
  path_ = name;
  if (std::optional<FileLock> lock = FileLock::take(sign(path_), FileLock::Wait::no))
    lock_.emplace(std::move(*lock));
}

WorkFolder::~WorkFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  try {
    const std::optional<FileLock> alone = FileLock::take(out_.lock(), FileLock::Wait::yes);
    fs::remove(out_.work(), error);     // unless another is in it
  } catch (const core::WriteFailed&) {  // then it stays, empty
  }
}

void remove_left_work(const OutFolder& out) {
  if (!fs::exists(out.work())) return;
  const std::optional<FileLock> alone = FileLock::take(out.lock(), FileLock::Wait::yes);
  remove_left_in(out.work());
}

void put(const fs::path& from, const fs::path& to) {
  make_folder(to.parent_path());
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw core::WriteFailed("cannot write " + to.string() + ": " + error.message());
}

void put_aside(const fs::path& from, const fs::path& to) {
  if (fs::exists(fs::symlink_status(from))) put(from, to);
}

}  // namespace morsel::tools::batch
