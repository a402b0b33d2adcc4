#include "morsel/core/text/numbers.h"

#include <cfloat>

namespace morsel::core {
namespace {

/// Room for the longest number before its decimals.
constexpr std::size_t kLongestNumber = DBL_MAX_10_EXP + 8;

std::string written(double value, std::chars_format format, int precision) {
  std::string text(kLongestNumber + static_cast<std::size_t>(precision), '\0');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr;
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}

}  // namespace

bool is_tiny(std::string_view digits) {
  long exponent = 0;
  const std::size_t e = digits.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view power = digits.substr(e + 1);
    const bool negative = power.starts_with('-');
    if (negative || power.starts_with('+')) power.remove_prefix(1);
    const auto result = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (result.ec == std::errc::result_out_of_range) return negative;
    if (negative) exponent = -exponent;
  }
  // The decimal place of the first digit that is not zero, next to the point.
  long place = 0;
  bool past_point = false;
  bool significant = false;
  for (const char c : digits.substr(0, e)) {
    if (c == '.') {
      past_point = true;
    } else if (c >= '0' && c <= '9') {
      significant = significant || c != '0';
      if (past_point && !significant) --place;
      if (!past_point && significant) ++place;
    }
  }
  return exponent + place < 0;
}

std::string to_digits(double value, int digits) { return written(value, std::chars_format::general, digits); }

std::string to_decimals(double value, int decimals) {
  return written(value, std::chars_format::fixed, decimals);
}

std::string grouped(std::uint64_t number) { return grouped_digits(std::to_string(number)); }

std::string grouped_digits(std::string_view digits) {
  std::string text(digits);
  for (auto place = static_cast<std::ptrdiff_t>(text.size()) - 3; place > 0; place -= 3)
    text.insert(static_cast<std::size_t>(place), ",");
  return text;
}

}  // namespace morsel::core
