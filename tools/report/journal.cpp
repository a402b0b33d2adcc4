#include "morsel/tools/report/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::tools {

Journal::Journal(std::filesystem::path path, const Json& key) : path_(std::move(path)) {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) fail(errno);
  try {
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) fail(errno);
      throw core::WriteFailed("cannot write " + path_.string() + ": another run is writing it");
    }
    const Json expected = Json::parse(json_text(key));  // as it is read back
    const std::size_t good = read(expected);
    if (ftruncate(file_, static_cast<off_t>(good)) != 0 || lseek(file_, 0, SEEK_END) < 0) fail(errno);
    if (good == 0) append(expected);
    is_empty_ = entries_.empty();
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() {
  if (is_empty_) unlink(path_.c_str());
  close(file_);
}

void Journal::add(const Json& entry) {
  const std::lock_guard lock(mutex_);
  append(entry);
  is_empty_ = false;
}

void Journal::finish() { is_empty_ = true; }

void Journal::fail(int error) const {
  throw core::WriteFailed("cannot write " + path_.string() + ": " + std::generic_category().message(error));
}

void Journal::append(const Json& value) {
  const std::string line = json_text(value) + '\n';
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = write(file_, line.data() + written, line.size() - written);
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) written += static_cast<std::size_t>(count);
  }
}

/// The length of what may stay.
std::size_t Journal::read(const Json& key) {
  std::string text;
  std::array<char, 1 << 16> buffer{};
  for (ssize_t count; (count = ::read(file_, buffer.data(), buffer.size())) != 0;) {
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  std::size_t good = 0;
  for (std::size_t end; (end = text.find('\n', good)) != std::string::npos; good = end + 1) {
    Json value = Json::parse(std::string_view(text).substr(good, end - good), nullptr, false);
    if (value.is_discarded()) break;
    if (good == 0) {
      if (value != key) return 0;
    } else {
      entries_.push_back(std::move(value));
    }
  }
  return good;
}

}  // namespace morsel::tools
