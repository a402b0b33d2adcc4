#pragma once
/// The bytes of a file in memory, for all readers. Internal.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace morsel::core {

/// Throws BadInput, which begins with `what`, if the file is missing, unreadable or not a regular file: of a
/// pipe, opening it or reading its bytes can take for ever.
void check_regular_file(const std::filesystem::path& path, const std::string& what);

/// The bytes of a file. Read, not mapped: a mapped file that is truncated while it is parsed ends the program
/// (SIGBUS).
class FileBytes {
 public:
  static constexpr std::size_t kAll = static_cast<std::size_t>(-1);

  /// Of a longer file the first `most`. Throws BadInput, naming the file as `name`, if it is missing,
  /// unreadable or not a regular file.
  FileBytes(const std::filesystem::path& path, const std::string& name, std::size_t most = kAll);
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace morsel::core
