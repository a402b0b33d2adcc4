#pragma once
/// Writing a file whole or not at all.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace morsel::core {

/// Whether commit() waits until the data are on disk. Even without that a target is whole or unchanged
/// however the program ends; only a power failure may lose data.
enum class Sync {
  when_replacing,  ///< so that a power failure never takes both the old file and the new
  never            ///< for large files that are easily made again
};

/// Where a file is to be written: made from a path, or an open file.
struct FileTarget {
  FileTarget(std::filesystem::path target, std::function<void(int)> before = {})
      : path(std::move(target)), before_appearing(std::move(before)) {}
  FileTarget(const std::string& target) : path(target) {}
  FileTarget(const char* target) : path(target) {}
  /// An open file, such as standard output, which is written directly, as a device is, and stays open.
  /// `called`: its name in errors; `format`: the extension that says what is written (".ply").
  static FileTarget open_file(int descriptor, std::string called, std::string format);

  bool is_open_file() const { return descriptor >= 0; }

  std::filesystem::path path;  ///< of an open file what it is called
  int descriptor = -1;         ///< of an open file
  std::string format;          ///< likewise; that of a path is its extension
  /// Is called with the descriptor of the complete file before it appears; if it throws, the file does not
  /// appear. Not called for a device or pipe.
  std::function<void(int)> before_appearing;
};

/// Writes to a file without a name in the target's folder (temporary_file.h); commit() makes it the target.
/// Without commit() (an error, a Cancelled, the end of the process) the target stays as it was.
/// Folders that the target is in are made; without commit() they are removed again if nothing is in them.
/// A target that exists keeps its permissions, and a symbolic link to it stays a link. A device or pipe
/// (/dev/stdout) cannot be replaced: it is written directly, and so is an open file.
///
/// All functions throw WriteFailed with the path and the system's reason. Buffered; not thread-safe.
class FileWriter {
 public:
  explicit FileWriter(const FileTarget& target, Sync sync = Sync::when_replacing);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  void write(std::string_view text);
  void write_bytes(const void* data, std::size_t size);
  /// The shortest text that reads back as the same double; independent of locales.
  void write_number(double value);
  void write_number(std::uint64_t value);
  /// A stream on the same file, for libraries that want one; writes may alternate. Its errors are thrown as
  /// WriteFailed too; it has the classic locale.
  std::ostream& stream();

  /// Makes the file appear, complete. Nothing may be written afterwards; a second commit does nothing.
  void commit();

 private:
  struct Output;
  std::unique_ptr<Output> output_;
};

/// A whole file at once.
void write_file(const FileTarget& target, std::string_view contents, Sync sync = Sync::when_replacing);

}  // namespace morsel::core
