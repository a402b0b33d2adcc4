#include "morsel/tools/results/result_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "lock";  // in a work folder

[[noreturn]] void fail_to_make(const fs::path& path, const std::string& reason) {
  throw core::WriteFailed("cannot make the folder " + path.string() + ": " + reason);
}

void check_inside(const fs::path& path) {
  if (!is_path_inside(path.native()))
    throw core::InvalidArgument("\"" + path.string() + "\" is not a path within a folder of results");
}

/// An entry of an open folder besides the list of its files, if there is one.
std::optional<std::string> first_entry(int folder, const fs::path& shown) {
  const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(again < 0 ? nullptr : ::fdopendir(again), &::closedir);
  if (!entries) {
    const int error = errno;
    if (again >= 0) ::close(again);
    fail_to_write(shown, error);
  }
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != ".." && name != FileList::kName) return std::string(name);
  }
  return std::nullopt;
}

/// Whether `morsel batch` of version 0.1 filled the folder, which listed nothing: one of the first states
/// that are found is its.
bool is_of_version_0_1(const fs::path& folder) {
  constexpr int kLookedAt = 50;
  std::error_code error;
  int looked_at = 0;
  for (fs::recursive_directory_iterator at(folder / "state", error), end;
       !error && at != end && looked_at < kLookedAt; at.increment(error), ++looked_at) {
    std::error_code no_file;
    if (at->path().extension() != ".json" || !fs::is_regular_file(at->symlink_status(no_file))) continue;
    std::string text(std::size_t{1} << 20, '\0');
    std::ifstream in(at->path(), std::ios::binary);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    if (text.find("\"morsel.batch-state/1\"") != std::string::npos) return true;
  }
  return false;
}

void refuse_if_not_empty(int folder, const fs::path& shown) {
  const std::optional<std::string> entry = first_entry(folder, shown);
  if (!entry) return;
  if (is_of_version_0_1(shown))
    throw core::InvalidArgument(
        "the folder " + shown.string() +
        " has results of morsel 0.1, which kept no list of its files: choose a new or an "
        "empty folder; those results may be removed by hand");
  throw core::InvalidArgument("the folder " + shown.string() + " is not empty (" + *entry +
                              ") and not one that morsel filled: choose a new or an empty folder");
}

/// False if another process has locked the file, and on a file system without locks.
bool try_lock(int file) {
  int result = 0;
  do result = ::flock(file, LOCK_EX | LOCK_NB);
  while (result != 0 && errno == EINTR);
  return result == 0;
}

std::string random_name() {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::string name;
  for (int i = 0; i < 8; ++i) name += kLetters[random() % kLetters.size()];
  return name;
}

std::string folder_entry(const fs::path& relative) { return relative.string() + "/"; }

}  // namespace

void ResultFolder::check(const fs::path& path) {
  const Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.is_open()) return;
  struct stat status {};
  if (::fstatat(folder.number(), FileList::kName, &status, AT_SYMLINK_NOFOLLOW) != 0 || status.st_size == 0)
    refuse_if_not_empty(folder.number(), path);
}

ResultFolder::ResultFolder(fs::path path, Options options)
    : path_(std::move(path)), stop_(std::move(options.stop)) {
  open();
  if (::faccessat(root_.number(), ".", W_OK | X_OK, AT_EACCESS) != 0) fail_to_write(path_, errno);
  for (const fs::path& output : options.taken) taken_.insert(file_place(output));
  try {
    list_.emplace(root_.number(), path_, stop_, [&] { refuse_if_not_empty(root_.number(), path_); });
  } catch (...) {
    remove_if_unused();
    throw;
  }
}

/// Until the object is destroyed no other run removes the folder.
void ResultFolder::open() {
  for (;;) {
    const std::error_code error = made_.make(path_);
    root_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!root_.is_open()) {
      const int reason = errno;
      made_.remove();
      if (reason == ENOTDIR) fail_to_make(path_, "a file of that name is there");
      fail_to_make(path_, error ? error.message() : std::generic_category().message(reason));
    }
    int result = 0;
    do result = ::flock(root_.number(), LOCK_SH);
    while (result != 0 && errno == EINTR);
    struct stat status {};
    if (::fstat(root_.number(), &status) != 0 || status.st_nlink > 0) return;
    // Another run, in which nothing was made, has just removed it.
  }
}

/// If no other run has the folder open: what the constructor made.
void ResultFolder::remove_if_unused() noexcept {
  if (!try_lock(root_.number())) return;
  try {
    if (list_ && list_->is_new()) {
      list_->lock({});
      // What was made but is not listed yet would make the folder look like somebody else's.
      if (!list_->entries().empty() || first_entry(root_.number(), path_)) return;
      if (::unlinkat(root_.number(), FileList::kName, 0) != 0) return;
    }
    made_.remove();
  } catch (const std::exception&) {  // an empty list is harmless
  }
}

ResultFolder::~ResultFolder() { remove_if_unused(); }

ResultFolder::Hold::Hold(ResultFolder& folder) : folder_(folder) {
  folder_.mutex_.lock();
  try {
    if (folder_.holds_ == 0) folder_.list_->lock(folder_.stop_);
  } catch (...) {
    folder_.mutex_.unlock();
    throw;
  }
  ++folder_.holds_;
}

ResultFolder::Hold::~Hold() {
  if (--folder_.holds_ == 0) folder_.list_->unlock();
  folder_.mutex_.unlock();
}

Descriptor ResultFolder::parent_of(const fs::path& relative, Missing missing) const {
  check_inside(relative);
  return open_below(root_.number(), relative.parent_path(), missing, path_);
}

std::optional<FileIdentity> ResultFolder::made_at(const fs::path& file) const {
  const fs::path place = path_ / file;
  if (taken_.contains(file_place(place)))
    throw core::WriteFailed("cannot write " + place.string() + ": it is another output of this run");
  const Descriptor folder = parent_of(file, Missing::tell);
  if (!folder.is_open()) return std::nullopt;
  const std::optional<FileIdentity> there = identity_of(folder.number(), file.filename());
  if (!there && errno == ENOENT) return std::nullopt;
  if (!there) fail_to_write(place, errno);
  if (!there->is_regular || !list_->has(file.native(), *there))
    throw core::WriteFailed(
        "cannot write " + place.string() +
        ": something is there that morsel did not make; move it away or choose another folder");
  return there;
}

/// The file is about to be put in its place.
void ResultFolder::list(const fs::path& file, const FileIdentity& made) {
  const Hold hold(*this);
  const std::optional<FileIdentity> before = made_at(file);
  // Of an older list: it is replaced only after the new one has been listed, and is no longer known by name.
  if (before && list_->entries().find(file.native())->second.empty()) list_->add_file(file.native(), *before);
  list_->add_file(file.native(), made);
}

core::FileTarget ResultFolder::claim(const fs::path& file) {
  const Hold hold(*this);
  made_at(file);
  return {path_ / file, [this, file](int written) {
            const std::optional<FileIdentity> made = identity_of(written);
            if (!made) fail_to_write(path_ / file, errno);
            list(file, *made);
          }};
}

void ResultFolder::check_free(const fs::path& file) {
  const Hold hold(*this);
  made_at(file);
}

void ResultFolder::check_folder(const fs::path& folder) {
  check_inside(folder);
  static_cast<void>(open_below(root_.number(), folder, Missing::tell, path_));
}

void ResultFolder::move(const fs::path& made, const fs::path& file) {
  const Hold hold(*this);
  const fs::path place = path_ / file;
  made_at(file);
  const Descriptor from = parent_of(made, Missing::tell);
  const Descriptor to = parent_of(file, Missing::make);
  if (!from.is_open()) fail_to_write(place, ENOENT);
  const std::optional<FileIdentity> moved = identity_of(from.number(), made.filename());
  if (!moved) fail_to_write(place, errno);
  list(file, *moved);
  if (::renameat(from.number(), made.filename().c_str(), to.number(), file.filename().c_str()) != 0)
    fail_to_write(place, errno);
}

void ResultFolder::remove(const fs::path& file) {
  const Hold hold(*this);
  if (!list_->has(file.native())) return;
  const Descriptor folder = parent_of(file, Missing::tell);
  const std::string name = file.filename();
  const std::optional<FileIdentity> there =
      folder.is_open() ? identity_of(folder.number(), name) : std::nullopt;
  if (there && there->is_regular && list_->has(file.native(), *there) &&
      ::unlinkat(folder.number(), name.c_str(), 0) != 0 && errno != ENOENT)
    throw core::WriteFailed("cannot remove " + (path_ / file).string() + ": " +
                            std::generic_category().message(errno));
  list_->remove(file.native());
  for (fs::path around = file.parent_path(); !around.empty(); around = around.parent_path()) {
    const Descriptor outer = parent_of(around, Missing::tell);
    if (!outer.is_open() || ::unlinkat(outer.number(), around.filename().c_str(), AT_REMOVEDIR) != 0) break;
  }
}

std::vector<std::string> ResultFolder::files_in(const fs::path& folder) {
  const Hold hold(*this);
  const std::string prefix = folder_entry(folder);
  std::vector<std::string> files;
  for (auto at = list_->entries().lower_bound(prefix);
       at != list_->entries().end() && at->first.starts_with(prefix); ++at)
    if (!at->first.ends_with('/')) files.push_back(at->first);
  return files;
}

ResultFolder::Work::Work(ResultFolder& folder, const fs::path& around) : folder_(folder) {
  const Hold hold(folder_);
  int error = EEXIST;
  while (error == EEXIST) {
    relative_ = around / random_name();
    const Descriptor outer = folder_.parent_of(relative_, Missing::make);
    folder_.list_->add_folder(folder_entry(relative_));
    error = ::mkdirat(outer.number(), relative_.filename().c_str(), 0777) == 0 ? 0 : errno;
    if (error != 0) folder_.list_->remove(folder_entry(relative_));
  }
  if (error != 0) fail_to_write(path(), error);
  const Descriptor inner = open_below(folder_.root_.number(), relative_, Missing::tell, folder_.path());
  lock_ =
      Descriptor(::openat(inner.number(), kLock, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!lock_.is_open()) fail_to_write(path() / kLock, errno);
  try_lock(lock_.number());
}

ResultFolder::Work::~Work() {
  folder_.remove_remade(relative_);
  constexpr int kTries = 2;  // another thread may hold descriptors for a moment
  for (int i = 0; i < kTries; ++i) {
    try {
      const Hold hold(folder_);
      if (folder_.remove_listed_work(relative_.parent_path(), folder_entry(relative_))) return;
    } catch (const std::exception&) {  // the next run removes it
    }
  }
}

/// If the user has removed the folder of results, a process that was still writing into a work folder has
/// made it again, without a list: what the user removed is not left there.
void ResultFolder::remove_remade(const fs::path& work) noexcept {
  struct stat status {};
  if (::fstat(root_.number(), &status) != 0 || status.st_nlink > 0) return;
  try {
    const Descriptor again(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!again.is_open()) return;
    const fs::path around = work.parent_path();
    const Descriptor outer = open_below(again.number(), around, Missing::tell, path_);
    if (!outer.is_open() || !remove_tree(outer.number(), work.filename())) return;
    ::unlinkat(again.number(), around.c_str(), AT_REMOVEDIR);  // unless something else is in it
    ::rmdir(path_.c_str());
  } catch (const std::exception&) {  // it is a folder of the user's now
  }
}

/// Of a work folder that no process uses. False if something of it is left.
bool ResultFolder::remove_listed_work(const fs::path& around, const std::string& entry) {
  const fs::path relative = entry.substr(0, entry.size() - 1);
  const Descriptor outer = parent_of(relative, Missing::tell);
  if (outer.is_open() && !remove_tree(outer.number(), relative.filename())) return false;
  if (!around.empty())
    if (const Descriptor top = parent_of(around, Missing::tell); top.is_open())
      ::unlinkat(top.number(), around.filename().c_str(), AT_REMOVEDIR);  // unless something else is in it
  list_->remove(entry);  // last: if something fails before, the next run removes it
  return true;
}

void ResultFolder::remove_left_work(const fs::path& around) {
  const Hold hold(*this);
  const std::string prefix = folder_entry(around);
  std::vector<std::string> left;
  for (auto at = list_->entries().lower_bound(prefix);
       at != list_->entries().end() && at->first.starts_with(prefix); ++at)
    if (at->first.ends_with('/')) left.push_back(at->first);
  for (const std::string& entry : left)
    if (is_abandoned(entry.substr(0, entry.size() - 1))) remove_listed_work(around, entry);
}

/// Whether no process uses a work folder. False if that is unknown, or if it is no longer a folder.
bool ResultFolder::is_abandoned(const fs::path& work) const {
  try {
    const Descriptor folder = open_below(root_.number(), work, Missing::tell, path_);
    if (!folder.is_open()) return true;
    const Descriptor lock(::openat(folder.number(), kLock, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    return lock.is_open() ? try_lock(lock.number()) : errno == ENOENT;
  } catch (const core::WriteFailed&) {
    return false;
  }
}

void ResultFolder::remove_work(const fs::path& relative) noexcept {
  try {
    if (const Descriptor outer = parent_of(relative, Missing::tell); outer.is_open())
      remove_tree(outer.number(), relative.filename());
  } catch (const std::exception&) {  // it is removed with the work folder
  }
}

}  // namespace morsel::tools
