#pragma once
/// What a file holds, whether it is compressed or not, and as the text that readers expect. Internal.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/decompression.h"
#include "morsel/core/io/file_bytes.h"

namespace morsel::core {

/// The extension that says what a file holds: as file_extension(), without one of a compression (.gz, .xz,
/// .zst): ".off" of "lion.OFF.gz".
std::string content_extension(const std::filesystem::path& path);

/// Bytes in memory, decompressed if they are gzip, xz or zstd data (once: not what is compressed twice), by
/// their content and whatever the file's name. `bytes` must outlive it.
class DecodedBytes {
 public:
  /// Throws as decompress(), naming the file as `name`.
  DecodedBytes(std::string_view bytes, const std::string& name, const Progress& progress = {});
  std::string_view view() const { return decompressed_ ? decompressed_->view() : plain_; }

 private:
  std::string_view plain_;
  std::optional<GrowingBytes> decompressed_;
};

/// Whether it is UTF-16 text: it begins with a byte-order mark and an ASCII character.
bool is_utf16(std::string_view bytes);
/// UTF-16 text with a byte-order mark as UTF-8. Throws BadInput, naming the file, where it is no valid
/// UTF-16.
std::string utf8_of_utf16(std::string_view bytes, const std::string& name);
/// What a reader says of such a text.
inline constexpr const char* kUtf16Warning = "it is UTF-16 text, which was converted";

/// The content of a file of text: decompressed, UTF-16 as UTF-8, without a byte-order mark, lines ending with
/// \n also where all of them end with \r, as on old Macs.
class TextContent {
 public:
  /// Throws BadInput, naming the file as `name`, if it is missing, unreadable or not a regular file, and as
  /// DecodedBytes and utf8_of_utf16().
  TextContent(const std::filesystem::path& path, const std::string& name, const Progress& progress = {});
  /// The same of a file's bytes, which must outlive it.
  TextContent(std::string_view bytes, const std::string& name, const Progress& progress = {});
  std::string_view view() const { return text_; }
  /// What was converted, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void convert(const std::string& name);

  std::optional<FileBytes> bytes_;  // none if they are another's
  DecodedBytes decoded_;
  std::string converted_;
  std::string_view text_;
  std::vector<std::string> warnings_;
};

}  // namespace morsel::core
