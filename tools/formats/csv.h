#pragma once
/// Tables of comma-separated values (RFC 4180).
///
/// Spreadsheets run a field as a formula that begins with = + - @, a tab or a line's end, also in quotes; and
/// names of files, and errors, may begin with anything. So such a path is written as ./PATH, which is the
/// same path, and any other such text, unless it is a number, with an apostrophe before it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// A text as a field: in quotes where it has a comma, a quote or a line's end.
std::string csv_field(std::string_view text);
/// A path as a field.
std::string csv_path(std::string_view path);

/// A line of fields.
class CsvLine {
 public:
  void add(std::string_view text) { add_raw(csv_field(text)); }
  void add(const char* text) { add(std::string_view(text)); }
  void add_path(std::string_view path) { add_raw(csv_path(path)); }
  void add(double value);
  void add(const std::optional<double>& value) { value ? add(*value) : add_raw(""); }
  void add(std::uint64_t value) { add_raw(std::to_string(value)); }
  /// Nothing for null, a text as it is, anything else as JSON.
  void add_json(const Json& value);
  /// Without the line's end.
  const std::string& text() const { return line_; }

 private:
  void add_raw(std::string_view field);

  std::string line_;
  bool first_ = true;
};

}  // namespace morsel::tools
