#include "morsel/tools/formats/json_stream.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"

namespace morsel::tools {
namespace {

/// Indents all lines but the first of a dumped value.
std::string indented(const std::string& text, std::size_t depth) {
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result.append(2 * depth, ' ');
  }
  return result;
}

void append_row(std::string& text, Row row);

/// Appends a row's values as Json::dump() writes them, without allocating.
struct CellWriter {
  std::string& text;

  void operator()(std::nullptr_t) const { text += "null"; }
  void operator()(std::uint64_t value) const { text.append(core::NumberText(value).view()); }
  void operator()(double value) const {
    if (!std::isfinite(value)) return (*this)(nullptr);
    std::array<char, 64> digits;  // the library's own digits, so that rows and members look alike
    text.append(digits.data(),
                nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), value));
  }
  void operator()(std::string_view value) const {
    const bool plain = std::all_of(value.begin(), value.end(),
                                   [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
    if (plain)
      text.append(1, '"').append(value).append(1, '"');
    else
      text += json_text(Json(value));
  }
  void operator()(std::span<const double, 3> position) const {
    char separator = '[';
    for (const double x : position) {
      text += separator;
      (*this)(x);
      separator = ',';
    }
    text += ']';
  }
  void operator()(const NestedRows& rows) const {
    text += '[';
    bool is_first = true;
    const TakeRow take = [&](Row row) {
      if (!is_first) text += ',';
      append_row(text, row);
      is_first = false;
    };
    for (std::size_t i = 0; i < rows.count; ++i) (*rows.make)(i, take);
    text += ']';
  }
};

void append_row(std::string& text, Row row) {
  const CellWriter writer{text};
  char separator = '{';
  for (const RowMember& member : row) {
    text += separator;
    writer(member.key);
    text += ':';
    std::visit(writer, member.value);
    separator = ',';
  }
  text += row.size() == 0 ? "{}" : "}";
}

}  // namespace

std::string json_text(const Json& value, int indent) {
  return core::json_printable(value.dump(indent, ' ', false, Json::error_handler_t::replace), "\n");
}

void JsonStream::write_out() {
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
}

void JsonStream::append_separator(std::string& text, bool is_first) const {
  text += is_first ? "\n" : ",\n";
  text.append(2 * has_items_.size(), ' ');
}

void JsonStream::next_item(std::string_view key) {
  if (!has_items_.empty()) {
    append_separator(text_, !has_items_.back());
    has_items_.back() = true;
  }
  if (!key.empty()) {
    CellWriter{text_}(key);
    text_ += ": ";
  }
}

void JsonStream::begin(std::string_view key, char bracket) {
  next_item(key);
  text_ += bracket;
  has_items_.push_back(false);
  write_out();
}

void JsonStream::end(char bracket) {
  const bool had_items = has_items_.back();
  has_items_.pop_back();
  if (had_items) text_.append(1, '\n').append(2 * has_items_.size(), ' ');
  text_ += bracket;
  if (has_items_.empty()) text_ += '\n';
  write_out();
}

void JsonStream::member(std::string_view key, const Json& value) {
  next_item(key);
  const bool flat = !value.is_structured() || value.empty();
  text_ += flat ? json_text(value) : indented(json_text(value, 2), has_items_.size());
  write_out();
}

void JsonStream::row(Row row) {
  core::throw_if_stopped();
  next_item({});
  append_row(text_, row);
  write_out();
}

void JsonStream::rows(std::size_t count, const MakeRow& make) {
  constexpr std::size_t kRows = 512;  // a text
  std::vector<std::string> texts(64);
  for (std::size_t begin = 0; begin < count; begin += kRows * texts.size()) {
    const std::size_t end = std::min(count, begin + kRows * texts.size());
    core::parallel_for(begin, end, kRows, [&](std::size_t first, std::size_t last) {
      std::string& text = texts[(first - begin) / kRows];
      text.clear();
      bool is_first = first == 0 && !has_items_.back();
      const TakeRow take = [&](Row row) {
        append_separator(text, is_first);
        append_row(text, row);
        is_first = false;
      };
      for (std::size_t i = first; i < last; ++i) make(i, take);
    });
    for (std::size_t k = 0; k * kRows < end - begin; ++k)
      out_.write(texts[k].data(), static_cast<std::streamsize>(texts[k].size()));
    has_items_.back() = true;
  }
}

}  // namespace morsel::tools
