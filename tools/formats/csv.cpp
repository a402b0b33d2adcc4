#include "morsel/tools/formats/csv.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "morsel/core/text/numbers.h"

namespace morsel::tools {
namespace {

bool begins_a_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos;
}

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && std::isfinite(number);
}

std::string in_quotes(std::string_view text) {
  if (text.find_first_of(",\"#\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string csv_field(std::string_view text) {
  return in_quotes(begins_a_formula(text) && !is_number(text) ? "'" + std::string(text) : std::string(text));
}

std::string csv_path(std::string_view path) {
  return in_quotes(begins_a_formula(path) ? "./" + std::string(path) : std::string(path));
}

void CsvLine::add(double value) { add_raw(core::shortest(value)); }

void CsvLine::add_json(const Json& value) {
  if (value.is_null())
    add_raw("");
  else if (value.is_string())
    add(std::string_view(value.get_ref<const std::string&>()));
  else
    add(std::string_view(json_text(value)));
}

void CsvLine::add_raw(std::string_view field) {
  if (fields_ > 0) line_ += ',';
  ++fields_;
  line_ += field;
}

CsvTable::CsvTable(std::ostream& out, const std::vector<std::string>& columns)
    : out_(out), columns_(columns.size()) {
  CsvLine names;
  for (const std::string& column : columns) names.add(column);
  out_ << names.text() << '\n';
}

void CsvTable::add(const CsvLine& row) {
  if (row.fields() != columns_)
    throw std::logic_error("a row of " + std::to_string(row.fields()) + " fields in a table of " +
                           std::to_string(columns_) + " columns");
  out_ << row.text() << '\n';
}

void CsvTable::end(const std::vector<std::string>& comments) {
  for (const std::string& line : comments) out_ << "# " << line << '\n';
}

}  // namespace morsel::tools
