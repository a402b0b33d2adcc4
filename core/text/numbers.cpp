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
