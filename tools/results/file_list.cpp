#include "morsel/tools/results/file_list.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstLine = "{\"schema\":\"morsel.results/1\"}";
constexpr std::size_t kMostBytes = std::size_t{1} << 28;
constexpr std::size_t kMostInLine = std::size_t{1} << 14;  // of the longest path with each byte as %XX
constexpr std::chrono::seconds kPatience{30};
constexpr std::chrono::milliseconds kPause{5};

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::optional<std::string> from_listed(std::string_view text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      path += text[i];
      continue;
    }
    const int high = i + 1 < text.size() ? digit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? digit(text[i + 2]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    path += static_cast<char>(16 * high + low);
    i += 2;
  }
  return path;
}

}  // namespace

std::string path_text(std::string_view path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      text += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    text += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

bool is_path_inside(std::string_view path) {
  if (path.empty() || path.find('\0') != std::string_view::npos || path == FileList::kName) return false;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view part = path.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..") return false;
    begin = end + 1;
  }
  return true;
}

FileList::FileList(int folder, const fs::path& shown, const std::stop_token& stop,
                   const std::function<void()>& before_making)
    : path_(shown / kName) {
  constexpr int kFlags = O_RDWR | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  file_ = Descriptor(::openat(folder, kName, kFlags));
  if (!file_.is_open() && errno == ENOENT) {
    before_making();
    file_ = Descriptor(::openat(folder, kName, kFlags | O_CREAT, 0666));
    is_new_ = file_.is_open();
  }
  if (!file_.is_open()) {
    if (errno == ELOOP || errno == EISDIR || errno == ENXIO) refuse("it is no file");
    fail_to_write(path_, errno);
  }
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) fail_to_write(path_, errno);
  if (!S_ISREG(status.st_mode)) refuse("it is no file");
  lock(stop);
  try {
    if (lines_ == 0) begin(folder, before_making);
  } catch (...) {
    unlock();
    throw;
  }
  unlock();
}

/// The first line, which a process that has just made the file has not written yet, or not completely before
/// it ended. The folder is unchanged in that case.
void FileList::begin(int folder, const std::function<void()>& before_making) {
  before_making();
  try {
    append(std::string(kFirstLine));
  } catch (const core::WriteFailed&) {
    ::unlinkat(folder, kName, 0);
    throw;
  }
  ++lines_;
}

void FileList::lock(const std::stop_token& stop) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (::flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) break;  // the file system has no locks
    if (stop.stop_requested()) throw core::Cancelled();
    if (std::chrono::steady_clock::now() > end)
      throw core::WriteFailed("cannot write into " + path_.parent_path().string() +
                              ": another run has locked it for half a minute");
    std::this_thread::sleep_for(kPause);
  }
  try {
    read();
  } catch (...) {
    unlock();
    throw;
  }
}

void FileList::unlock() noexcept { ::flock(file_.number(), LOCK_UN); }

void FileList::refuse(const std::string& reason) const {
  throw core::BadInput(path_.string() + ", the list of the files that morsel made, is damaged: " + reason +
                       "; choose a new or an empty folder");
}

void FileList::read() {
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) fail_to_write(path_, errno);
  if (status.st_nlink == 0) fail_to_write(path_, ENOENT);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > kMostBytes) refuse("it has more than 256 MiB");
  if (size < read_) refuse("it became shorter while it was in use");
  std::string rest;  // of what is read, the line that has not ended yet
  std::array<char, std::size_t{1} << 16> buffer;
  for (std::size_t at = read_; at < size;) {
    const ssize_t count =
        ::pread(file_.number(), buffer.data(), std::min(buffer.size(), size - at), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_write(path_, errno);
    if (count == 0) break;
    at += static_cast<std::size_t>(count);
    rest.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end; (end = rest.find('\n', begin)) != std::string::npos; begin = end + 1) {
      take_line(std::string_view(rest).substr(begin, end - begin));
      read_ += end + 1 - begin;
    }
    rest.erase(0, begin);
    if (rest.size() > kMostInLine) refuse("line " + std::to_string(lines_ + 1) + " is too long");
  }
  has_rest_ = !rest.empty();
  if (lines_ == 0 && !kFirstLine.starts_with(rest)) refuse("it has another first line");
}

void FileList::take_line(std::string_view line) {
  ++lines_;
  if (lines_ == 1) {
    if (line != kFirstLine) refuse("it has another first line, perhaps of another version");
    return;
  }
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::optional<std::string> entry =
      blank > 1 && line.size() <= kMostInLine ? from_listed(line.substr(1, blank - 1)) : std::nullopt;
  const std::optional<FileIdentity> file =
      blank < line.size() ? FileIdentity::from_text(line.substr(blank + 1)) : std::nullopt;
  std::string_view path = entry ? std::string_view(*entry) : std::string_view();
  if (path.ends_with('/')) path.remove_suffix(1);
  const bool has_sign = line.starts_with('+') || (line.starts_with('-') && !file);
  if (!is_path_inside(path) || !has_sign || (blank < line.size() && !file))
    refuse("line " + std::to_string(lines_) + " is not that of a file in the folder");
  if (line.front() == '-')
    entries_.erase(*entry);
  else if (std::vector<FileIdentity>& files = entries_[*entry]; file)
    files.push_back(*file);
}

bool FileList::has(std::string_view entry, const FileIdentity& file) const {
  const auto found = entries_.find(entry);
  if (found == entries_.end()) return false;
  const std::vector<FileIdentity>& files = found->second;
  return files.empty() || std::any_of(files.begin(), files.end(),
                                      [&](const FileIdentity& listed) { return listed.is_that_of(file); });
}

void FileList::add_folder(const std::string& entry) {
  if (has(entry)) return;
  append("+" + path_text(entry));
  entries_.try_emplace(entry);
}

void FileList::add_file(const std::string& entry, const FileIdentity& file) {
  append("+" + path_text(entry) + " " + file.text());
  entries_[entry].push_back(file);
}

void FileList::remove(const std::string& entry) {
  if (!has(entry)) return;
  append("-" + path_text(entry));
  entries_.erase(entry);
}

void FileList::append(const std::string& text) {
  const std::string line = text + '\n';
  if (read_ + line.size() > kMostBytes)
    throw core::WriteFailed("cannot write " + path_.string() +
                            ": it has reached 256 MiB; choose a new folder");
  if (has_rest_ && ::ftruncate(file_.number(), static_cast<off_t>(read_)) != 0) fail_to_write(path_, errno);
  has_rest_ = false;
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = ::write(file_.number(), line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int error = count < 0 ? errno : ENOSPC;
      static_cast<void>(!::ftruncate(file_.number(), static_cast<off_t>(read_)));
      fail_to_write(path_, error);
    }
    written += static_cast<std::size_t>(count);
  }
  read_ += line.size();
}

}  // namespace morsel::tools
