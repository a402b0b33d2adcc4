#include "morsel/morse/smoothing/value_range.h"

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"

namespace morsel::morse {

ValueRange parse_value_range(std::string_view text, std::string_view what) {
  using Kind = ValueRange::Kind;
  if (text == "local") return {Kind::local, 1};
  if (text == "literal") return {Kind::literal, 1};
  if (text == "none") return {Kind::none, 1};
  const bool deviations = text.ends_with("std");
  const std::string allowed =
      std::string(what) + " (or else local, literal, none or a multiple such as 1std)";
  const double value = core::parse_number(deviations ? text.substr(0, text.size() - 3) : text, allowed);
  if (!(value > 0))
    throw core::InvalidArgument(std::string(what) + " must be above 0, not " + std::string(text));
  return {deviations ? Kind::deviations : Kind::fixed, value};
}

std::string to_string(const ValueRange& range) {
  switch (range.kind) {
    case ValueRange::Kind::local:
      return "local";
    case ValueRange::Kind::literal:
      return "literal";
    case ValueRange::Kind::none:
      return "none";
    case ValueRange::Kind::fixed:
      return core::shortest(range.value);
    case ValueRange::Kind::deviations:
      break;
  }
  return core::shortest(range.value) + "std";
}

}  // namespace morsel::morse
