#include "morsel/core/io/file_writer.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <locale>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/links.h"
#include "morsel/core/io/made_folders.h"
#include "morsel/core/io/temporary_file.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

/// Another number for an open file that can be written to, else -1 and errno.
int duplicate(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags < 0) return -1;
  if ((flags & O_PATH) != 0 || (flags & O_ACCMODE) == O_RDONLY) {
    errno = EBADF;
    return -1;
  }
  return ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
}

}  // namespace

FileTarget FileTarget::open_file(int descriptor, std::string called, std::string format) {
  FileTarget target(std::move(called));
  target.descriptor = descriptor;
  target.format = std::move(format);
  return target;
}

struct FileWriter::Output {
  Output(const FileTarget& file_target, Sync sync);
  ~Output() {
    if (device >= 0) ::close(device);
    temporary.discard();
    made.remove();
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void append(const char* data, std::size_t size) {
    if (file() < 0) throw std::logic_error("FileWriter: written after commit()");
    if (size > buffer.size() - used) {
      flush();
      if (size > buffer.size()) {
        write_out(data, size);
        return;
      }
    }
    std::copy_n(data, size, buffer.data() + used);
    used += size;
  }
  void flush() { write_out(buffer.data(), std::exchange(used, 0)); }
  void write_out(const char* data, std::size_t size);
  void commit();
  int publish();
  void open(const FileTarget& file_target, Sync sync);
  void open_temporary(const fs::path& target);
  [[noreturn]] void fail(const std::string& reason) const {
    throw WriteFailed("cannot write " + shown + ": " + reason);
  }
  [[noreturn]] void fail(int error) const { fail(std::generic_category().message(error)); }
  int file() const { return device >= 0 ? device : temporary.descriptor(); }

  struct StreamBuffer : std::streambuf {
    explicit StreamBuffer(Output& o) : output(o) {}
    int_type overflow(int_type c) override {
      if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
      const char byte = traits_type::to_char_type(c);
      output.append(&byte, 1);
      return c;
    }
    std::streamsize xsputn(const char* data, std::streamsize size) override {
      output.append(data, static_cast<std::size_t>(size));
      return size;
    }
    Output& output;
  };

  std::string shown;  // as the caller named it
  std::function<void(int)> before_appearing;
  TemporaryFile temporary;
  int device = -1;   // written to instead, if there is one
  fs::path folder;   // of the target
  MadeFolders made;  // removed without commit()
  bool synced = false;
  std::vector<char> buffer;
  std::size_t used = 0;
  StreamBuffer stream_buffer{*this};
  std::ostream stream{&stream_buffer};
};

FileWriter::Output::Output(const FileTarget& file_target, Sync sync)
    : shown((file_target.is_open_file() ? "to " : "") + file_target.path.string()),
      before_appearing(file_target.before_appearing),
      buffer(kBufferSize) {
  open(file_target, sync);
  stream.imbue(std::locale::classic());
  stream.precision(17);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
}

void FileWriter::Output::open(const FileTarget& file_target, Sync sync) {
  const fs::path& target = file_target.path;
  if (file_target.is_open_file()) {
    device = duplicate(file_target.descriptor);
    if (device < 0) fail(errno);
    return;
  }
  if (!target.has_filename()) fail("that is not the name of a file");
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if ((exists && !S_ISREG(status.st_mode)) || is_descriptor_path(target)) {
    device = ::open(target.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (device < 0) fail(errno);
    return;
  }
  // Renaming would replace a file that its owner has protected.
  if (exists && ::access(target.c_str(), W_OK) != 0) fail(errno);
  open_temporary(followed(target));
  if (exists) static_cast<void>(::fchmod(temporary.descriptor(), status.st_mode & 07777));
  synced = exists && sync == Sync::when_replacing;
}

void FileWriter::Output::open_temporary(const fs::path& target) {
  constexpr int kTries = 3;  // another run may remove the folder that it made, too
  folder = target.parent_path();
  int error = ENOENT;
  for (int i = 0; i < kTries && error == ENOENT; ++i) {
    static_cast<void>(made.make(folder));  // if this fails, open() reports the reason
    error = temporary.open(target);
  }
  if (error != 0) {
    made.remove();
    fail(error);
  }
}

void FileWriter::Output::write_out(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file(), data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno == EAGAIN && device >= 0) {  // another process has made the pipe non-blocking
        pollfd wait{device, POLLOUT, 0};
        static_cast<void>(::poll(&wait, 1, -1));
        continue;
      }
      fail(errno);
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// A file without a name does not keep its folder: another run that made the folder may have removed it.
int FileWriter::Output::publish() {
  const int error = temporary.publish(synced);
  if (error != ENOENT || made.make(folder)) return error;
  return temporary.publish(synced);
}

void FileWriter::Output::commit() {
  if (file() < 0) return;
  flush();
  if (device < 0 && before_appearing) before_appearing(temporary.descriptor());
  int error = 0;
  if (device < 0)
    error = publish();
  else if (::close(std::exchange(device, -1)) != 0 && errno != EINTR)
    error = errno;
  if (error != 0) fail(error);
  made.keep();
}

FileWriter::FileWriter(const FileTarget& target, Sync sync)
    : output_(std::make_unique<Output>(target, sync)) {}

FileWriter::~FileWriter() = default;

void FileWriter::write(std::string_view text) { output_->append(text.data(), text.size()); }

void FileWriter::write_bytes(const void* data, std::size_t size) {
  output_->append(static_cast<const char*>(data), size);
}

void FileWriter::write_number(double value) { write(NumberText(value).view()); }

void FileWriter::write_number(std::uint64_t value) { write(NumberText(value).view()); }

std::ostream& FileWriter::stream() { return output_->stream; }

void FileWriter::commit() { output_->commit(); }

void write_file(const FileTarget& target, std::string_view contents, Sync sync) {
  FileWriter writer(target, sync);
  writer.write(contents);
  writer.commit();
}

}  // namespace morsel::core
