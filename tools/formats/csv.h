#pragma once
/// Tables of comma-separated values (RFC 4180).
///
/// Spreadsheets run a field as a formula that begins with = + - @, a tab or a line's end, also in quotes; and
/// names of files, and errors, may begin with anything. So such a path is written as ./PATH, which is the
/// same path, and any other such text, unless it is a number, with an apostrophe before it.
///
/// Where a table has comments, lines that begin with #, they are its last lines: numpy.genfromtxt takes the
/// names of columns from the first line, even from a comment, and pandas (comment="#") and spreadsheets find
/// the names there, too. Fields with a # are in quotes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// A text as a field: in quotes where it has a comma, a quote, a # or a line's end.
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
  std::size_t fields() const { return fields_; }

 private:
  void add_raw(std::string_view field);

  std::string line_;
  std::size_t fields_ = 0;
};

/// A table as it is written: the names of its columns, then row by row.
class CsvTable {
 public:
  /// Writes the names. Refers to `out`.
  CsvTable(std::ostream& out, const std::vector<std::string>& columns);
  /// Throws std::logic_error if it has not a field for each column.
  void add(const CsvLine& row);
  /// Comment lines below the rows, each without its mark; nothing may follow.
  void end(const std::vector<std::string>& comments);

 private:
  std::ostream& out_;
  std::size_t columns_;
};

}  // namespace morsel::tools
