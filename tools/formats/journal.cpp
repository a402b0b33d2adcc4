#include "morsel/tools/formats/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

constexpr std::string_view kSchema = "morsel.journal/1";
constexpr std::string_view kBegin = R"({"schema":"morsel.journal/1","key":)";
constexpr std::size_t kMostLine = std::size_t{16} << 20;  // bytes

Json read_line_as_json(std::string_view line) { return read_json(line, "the line", {.bytes = kMostLine}); }

/// Whether the text is the start of a journal's first line that was cut off while it was written.
bool is_cut_head(std::string_view text) {
  return text.starts_with(kBegin.substr(0, std::min(text.size(), kBegin.size())));
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "y" : "ies");
}

}  // namespace

Json journal_key(std::string_view line) {
  const Json head = read_line_as_json(line);
  const JsonView view(head, "it is no journal");
  if (view["schema"].text() != kSchema) view["schema"].refuse("is that of another document");
  return view["key"].json();
}

Journal::Journal(std::filesystem::path path, const Json& key) : path_(std::move(path)) {
  open_file();
  try {
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) fail(errno);
      throw core::WriteFailed("cannot write " + path_.string() + ": another run is writing it");
    }
    const Json expected = read_line_as_json(json_text(key));  // as it is read back
    read(expected);
    if (!has_head_) begin(expected);
    is_empty_ = entries_.empty();
  } catch (...) {
    close(file_);
    throw;
  }
}

/// A file that cannot be begun is not left: it has no entries.
void Journal::begin(const Json& key) {
  try {
    append({{"schema", kSchema}, {"key", key}});
  } catch (const core::WriteFailed&) {
    unlink(path_.c_str());
    throw;
  }
}

Journal::~Journal() {
  if (is_empty_) unlink(path_.c_str());
  close(file_);
}

void Journal::take_entries(const std::function<void(const JsonView&)>& take) {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    try {
      take(JsonView(entries_[i], "an entry is damaged"));
    } catch (const core::BadInput& error) {
      drop(lines_[i], error.what());
    }
  }
}

std::vector<std::string> Journal::warnings() const {
  std::vector<std::string> texts;
  if (had_other_key_)
    texts.push_back(path_.string() +
                    " is of a run with another mesh, other options or another version: a new one is started");
  if (dropped_ > 0)
    texts.push_back(path_.string() + ": " + counted(dropped_, "damaged entr") +
                    (dropped_ == 1 ? " counts as absent" : " count as absent") + " and will be made again (" +
                    why_dropped_ + ")");
  return texts;
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

/// A link is not followed: the user has not named this file.
void Journal::open_file() {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  const int error = errno;
  const auto refuse = [&](const char* what) {
    throw core::InvalidArgument(path_.string() + ", the journal of the run, is " + what +
                                ": move it away or choose another output");
  };
  struct stat about {};
  if (file_ < 0 && error == ELOOP) refuse("a link");
  if (file_ < 0) fail(error);
  if (fstat(file_, &about) == 0 && S_ISREG(about.st_mode)) return;
  close(file_);
  refuse("not a file");
}

void Journal::append(const Json& value) {
  const std::string line = json_text(value) + '\n';
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = write(file_, line.data() + written, line.size() - written);
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) written += static_cast<std::size_t>(count);
  }
}

/// Overwrites a line with white space, which is skipped when the file is read.
void Journal::blank(const Line& line) {
  const std::string spaces(std::min<std::size_t>(line.size, 1 << 16), ' ');
  for (std::size_t done = 0; done < line.size;) {
    const ssize_t count = pwrite(file_, spaces.data(), std::min(spaces.size(), line.size - done),
                                 line.begin + static_cast<off_t>(done));
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

void Journal::drop(const Line& line, const std::string& why) {
  if (dropped_++ == 0) why_dropped_ = why;
  blank(line);
}

/// Reads the file and removes its invalid parts, so that it can be appended to.
void Journal::read(const Json& head) {
  std::string text;  // from `begin` on
  off_t begin = 0;
  std::size_t searched = 0;
  std::array<char, 1 << 16> buffer{};
  bool goes_on = true;
  for (ssize_t count; goes_on && (count = ::read(file_, buffer.data(), buffer.size())) != 0;) {
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t done = 0;
    for (std::size_t end; goes_on && (end = text.find('\n', std::max(done, searched))) != std::string::npos;
         done = end + 1)
      goes_on = read_line(std::string_view(text).substr(done, end - done),
                          {begin + static_cast<off_t>(done), end - done}, head);
    text.erase(0, done);
    begin += static_cast<off_t>(done);
    searched = text.size();
    if (text.size() <= kMostLine) continue;
    if (has_head_ && dropped_++ == 0)
      why_dropped_ = "a line has more than " + std::to_string(kMostLine) + " bytes";
    break;
  }
  if (!has_head_ && !had_other_key_ && !is_cut_head(text)) read_line(text, {}, head);  // which throws
  const off_t good = has_head_ ? begin : 0;
  if (ftruncate(file_, good) != 0 || lseek(file_, 0, SEEK_END) < 0) fail(errno);
}

/// Returns false if the file is that of another run.
bool Journal::read_line(std::string_view text, const Line& line, const Json& key) {
  if (!has_head_) {
    try {
      had_other_key_ = journal_key(text) != key;
    } catch (const core::BadInput&) {
      throw core::InvalidArgument(
          path_.string() +
          " is there and is no journal of this program's version: move it away or choose another output");
    }
    has_head_ = !had_other_key_;
    return has_head_;
  }
  if (text.find_first_not_of(' ') == std::string_view::npos) return true;
  try {
    entries_.push_back(read_line_as_json(text));
    lines_.push_back(line);
  } catch (const core::BadInput& error) {
    drop(line, error.what());
  }
  return true;
}

}  // namespace morsel::tools
