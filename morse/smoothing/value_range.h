#pragma once
/// The standard deviation of the bilateral filter's weight of values.

#include <cstdint>
#include <string>
#include <string_view>

namespace morsel::morse {

/// How σ_s, the standard deviation of the weight of values, is chosen.
struct ValueRange {
  enum class Kind : std::uint8_t {
    deviations,  ///< `value` standard deviations (population's, over vertices) of the input, fixed once
    local,       ///< the largest abs(f(x) − f(v)) in v's neighbourhood, recomputed in each iteration
    literal,     ///< σ, a length: the paper's text as it stands
    fixed,       ///< `value`, in the field's unit
    none         ///< infinite: W_s = 1, so that f + S is the Gaussian average of f
  };
  Kind kind = Kind::deviations;
  double value = 1;  ///< finite and above 0; only for deviations and fixed

  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// "1std", "0.5std", "local", "literal", "none" or a number; throws InvalidArgument, naming `what`, on
/// anything else.
ValueRange parse_value_range(std::string_view text, std::string_view what);
/// The text that parse_value_range() reads back as the same.
std::string to_string(const ValueRange& range);

}  // namespace morsel::morse
