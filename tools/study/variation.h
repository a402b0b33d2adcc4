#pragma once
/// A parameter and its values in a parameter sweep, in the syntax of the command line.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace morsel::tools {

struct Variation {
  std::string key;                  ///< as given: "sigma", "salient.sigma", "2.sigma", "field.scale"
  std::vector<std::string> values;  ///< one or more, all different, in the syntax of specifications
};

/// The most values of one variation.
inline constexpr std::size_t kMostValues = 100'000;

/// Reads "KEY=VALUE,VALUE…". A value is a text, or stands for several: A..B from A to B by 1 (down, if B is
/// less), A..B..S by S, A..B..xF by the factor F; B is one of them if it is met up to rounding. Numbers may
/// have a unit ("2eps..16eps..x2"), each the same or none; they are written with up to 12 digits. A backslash
/// keeps a comma in a value.
///
/// Throws InvalidArgument, quoting the text, on an empty key or value, an invalid range, a value given
/// twice and more than kMostValues.
Variation parse_variation(std::string_view text);

/// The values as numbers, if all are numbers with the same unit, which is written to `unit`; else empty.
std::vector<double> numbers_of(const std::vector<std::string>& values, std::string& unit);

}  // namespace morsel::tools
