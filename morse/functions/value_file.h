#pragma once
/// A text file with a value a line. Internal.

#include <cstddef>
#include <filesystem>
#include <istream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// The values of a text, and on which line each stood. Blank lines and what follows a # do not count; values
/// need not be finite.
class ValueFile {
 public:
  /// Throws BadInput, naming the file as `name`, the line and its text, if a line is not one number.
  ValueFile(std::istream& stream, std::string name, const core::Progress& progress);
  /// Of a file, which may be compressed (gzip, xz, zstd) or UTF-16. Throws BadInput also if it is missing,
  /// unreadable or not a regular file.
  static ValueFile read(const std::filesystem::path& path, const core::Progress& progress);

  std::span<const double> values() const { return values_; }
  /// "line 12".
  std::string place(std::size_t i) const;

 private:
  double parse(std::string_view text, std::size_t number) const;

  std::string name_;
  std::vector<double> values_;
  std::vector<std::size_t> skipped_;  // per line without a value: how many values came before
};

}  // namespace morsel::morse
