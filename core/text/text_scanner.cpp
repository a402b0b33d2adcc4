#include "morsel/core/text/text_scanner.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"

namespace morsel::core {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

void fail_reading(const std::string& file, const std::string& what) {
  throw BadInput("cannot read \"" + file + "\": " + what);
}

std::string shown(std::string_view word) {
  constexpr std::size_t kLongest = 24;
  std::string text = "\"";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "…\"" : "\"");
}

TextScanner::TextScanner(std::string_view text, const std::string& file, Syntax syntax,
                         const Progress& progress)
    : begin_(text.data()),
      end_(text.data() + text.size()),
      next_(begin_),
      syntax_(syntax),
      file_(file),
      progress_(progress) {
  if (text.starts_with("\xEF\xBB\xBF")) next_ += 3;  // a byte-order mark
  if (syntax.terminator != 0)
    terminator_ = syntax.terminator;
  else if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos)
    terminator_ = '\r';
  cursor_ = line_end_ = next_;
}

bool TextScanner::next_raw_line() {
  if (next_ == end_) return false;
  cursor_ = next_;
  const auto* found = static_cast<const char*>(std::memchr(cursor_, terminator_, remaining()));
  line_end_ = found == nullptr ? end_ : found;
  next_ = found == nullptr ? end_ : found + 1;
  ++line_;
  advance();
  return true;
}

void TextScanner::report() const {
  progress_.update("reading the mesh",
                   static_cast<double>(cursor_ - begin_) / static_cast<double>(end_ - begin_));
}

bool TextScanner::next_line() {
  while (next_raw_line())
    if (!at_line_end()) return true;
  cursor_ = line_end_;
  return false;
}

bool TextScanner::at_line_end() {
  for (;;) {
    while (cursor_ < line_end_ && is_blank(*cursor_)) ++cursor_;
    if (cursor_ == line_end_) return true;
    if (*cursor_ == syntax_.comment && syntax_.comment != 0) {
      cursor_ = line_end_;
      return true;
    }
    if (!is_continuation(cursor_)) return false;
    cursor_ = line_end_;
    if (!next_raw_line()) return true;
  }
}

bool TextScanner::is_continuation(const char* c) const {
  if (!syntax_.continuation || c == line_end_ || *c != '\\') return false;
  for (++c; c < line_end_; ++c)
    if (!is_blank(*c)) return false;
  return true;
}

bool TextScanner::ends_word(const char* c) const {
  return c == line_end_ || is_blank(*c) || (*c == syntax_.comment && syntax_.comment != 0) ||
         is_continuation(c);
}

std::string_view TextScanner::peek_word() const {
  const char* end = cursor_;
  while (!ends_word(end)) ++end;
  return {cursor_, static_cast<std::size_t>(end - cursor_)};
}

std::string_view TextScanner::word() {
  if (at_line_end()) return {};
  const std::string_view result = peek_word();
  cursor_ += result.size();
  advance();
  return result;
}

std::string_view TextScanner::word_on_any_line() {
  if (at_line_end() && !next_line()) return {};
  return word();
}

template <class Float>
double TextScanner::parse(std::string_view what) {
  if (at_line_end()) fail("the line ends where " + std::string(what) + " should be");
  Float value = 0;
  const auto [stop, error] = read_number(cursor_, line_end_, value);
  if (error == std::errc::invalid_argument || !ends_word(stop))
    fail("expected " + std::string(what) + ", found " + shown(peek_word()));
  if (error == std::errc::result_out_of_range)
    fail(std::string(what) + " is too large a number: " + shown(peek_word()));
  cursor_ = stop;
  advance();
  return value;
}

double TextScanner::number(std::string_view what) { return parse<double>(what); }

double TextScanner::single_number(std::string_view what) { return parse<float>(what); }

std::int64_t TextScanner::leading_integer(std::string_view what) {
  if (at_line_end()) fail("the line ends where " + std::string(what) + " should be");
  const char* start = cursor_;
  if (*start == '+' && start + 1 < line_end_ && start[1] != '-') ++start;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(start, line_end_, value);
  if (error == std::errc::invalid_argument)
    fail("expected " + std::string(what) + ", found " + shown(peek_word()));
  if (error == std::errc::result_out_of_range)
    fail(std::string(what) + " is too large a number: " + shown(peek_word()));
  cursor_ = stop;
  advance();
  return value;
}

std::int64_t TextScanner::integer(std::string_view what) {
  at_line_end();
  const char* start = cursor_;
  const std::int64_t value = leading_integer(what);
  if (ends_word(cursor_)) return value;
  cursor_ = start;
  fail("expected " + std::string(what) + ", found " + shown(peek_word()));
}

TextScanner::Whole TextScanner::whole_number(std::string_view what) {
  at_line_end();
  const std::string_view digits = peek_word();
  const std::size_t other = digits.find_first_not_of("+-0123456789");
  if (other == std::string_view::npos) return {integer(what), false};
  constexpr double kExact = 9007199254740992;  // 2⁵³
  double value = kExact;
  const char* const first = digits.data() + (digits.size() > 1 && digits[0] == '+' && digits[1] != '-');
  const auto [stop, error] = std::from_chars(first, digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size() || !(std::abs(value) < kExact) ||
      std::trunc(value) != value)
    fail("expected " + std::string(what) + ", found " + shown(digits));
  cursor_ = stop;
  advance();
  return {static_cast<std::int64_t>(value), true};
}

void TextScanner::fail(const std::string& what) const {
  fail_reading(file_, "line " + std::to_string(line_) + ": " + what);
}

void TextScanner::fail_at_end(const std::string& what) const {
  fail_reading(file_, "it ends at line " + std::to_string(line_) + ", " + what);
}

}  // namespace morsel::core
