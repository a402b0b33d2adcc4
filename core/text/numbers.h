#pragma once
/// Numbers as text: as written to files and for people, and as read back.

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace morsel::core {

/// The shortest text that reads back as the same number, without an allocation: for files of many numbers.
class NumberText {
 public:
  explicit NumberText(double value) : NumberText(value, 0) {}
  explicit NumberText(std::uint64_t value) : NumberText(value, 0) {}
  std::string_view view() const { return {text_.data(), size_}; }

 private:
  template <class Number>
  NumberText(Number value, int) {
    size_ = static_cast<std::size_t>(std::to_chars(text_.data(), text_.data() + text_.size(), value).ptr -
                                     text_.data());
  }

  std::array<char, 32> text_;
  std::size_t size_ = 0;
};

/// The same as a string.
inline std::string shortest(double value) { return std::string(NumberText(value).view()); }

/// Whether the number that `digits` stands for is too small for its type: zero or subnormal. std::from_chars
/// calls both ends of the range an error.
bool is_tiny(std::string_view digits);

/// Reads a floating-point number at the start of a text, independent of locales: as std::from_chars, but with
/// a + before it, too, and what is too small for the type is 0 with its sign.
template <class Float>
std::from_chars_result read_number(const char* begin, const char* end, Float& value) {
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range &&
      is_tiny({begin, static_cast<std::size_t>(result.ptr - begin)})) {
    value = *begin == '-' ? -Float{0} : Float{0};
    result.ec = {};
  }
  return result;
}

/// As many significant digits as a person wants to read.
inline constexpr int kReadableDigits = 6;

/// Rounded to that many significant digits, as printf's %g: 1234567 → "1.23457e+06", 0.5 → "0.5".
std::string to_digits(double value, int digits = kReadableDigits);

/// With that many decimals, as printf's %f: 0.5 → "0.50".
std::string to_decimals(double value, int decimals);

/// 1234567 → "1,234,567".
std::string grouped(std::uint64_t number);
/// The same for digits of any number.
std::string grouped_digits(std::string_view digits);

}  // namespace morsel::core
