#include "morsel/tools/report/json_stream.h"

#include <string>

namespace morsel::tools {
namespace {

/// Text that is not UTF-8 (a path may hold any bytes) is written with replacement characters.
std::string dump(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Indents all lines but the first of a dumped value.
std::string indented(const std::string& text, std::size_t depth) {
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result.append(2 * depth, ' ');
  }
  return result;
}

}  // namespace

void JsonStream::next_item(std::string_view key) {
  if (!has_items_.empty()) {
    out_ << (has_items_.back() ? ",\n" : "\n") << std::string(2 * has_items_.size(), ' ');
    has_items_.back() = true;
  }
  if (!key.empty()) out_ << dump(Json(key), -1) << ": ";
}

void JsonStream::begin(std::string_view key, char bracket) {
  next_item(key);
  out_ << bracket;
  has_items_.push_back(false);
}

void JsonStream::end(char bracket) {
  const bool had_items = has_items_.back();
  has_items_.pop_back();
  if (had_items) out_ << '\n' << std::string(2 * has_items_.size(), ' ');
  out_ << bracket;
  if (has_items_.empty()) out_ << '\n';
}

void JsonStream::member(std::string_view key, const Json& value) {
  next_item(key);
  const bool flat = !value.is_structured() || value.empty();
  out_ << (flat ? dump(value, -1) : indented(dump(value, 2), has_items_.size()));
}

void JsonStream::element(const Json& value) {
  next_item({});
  out_ << dump(value, -1);
}

}  // namespace morsel::tools
