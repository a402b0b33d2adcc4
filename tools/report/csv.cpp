#include "morsel/tools/report/csv.h"

#include "morsel/core/parameters.h"

namespace morsel::tools {

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
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
  if (!first_) line_ += ',';
  first_ = false;
  line_ += field;
}

}  // namespace morsel::tools
