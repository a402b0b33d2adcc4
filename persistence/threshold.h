#pragma once
/// Persistence thresholds as users give them.

#include <string>
#include <string_view>

#include "morsel/core/field/scalar_field.h"

namespace morsel::persistence {

/// A persistence: in the field's unit, or as a percentage of the field's range.
struct Threshold {
  double value = 0;
  bool in_percent = false;

  static constexpr Threshold absolute(double value) { return {value, false}; }
  static constexpr Threshold percent(double value) { return {value, true}; }

  /// In the unit of `field`. Throws InvalidArgument if the value is negative or not finite.
  double on(const core::ScalarField& field) const;

  friend bool operator==(const Threshold&, const Threshold&) = default;
};

/// "0.1%" or "3.5"; parse_threshold() reads it back exactly.
std::string to_string(const Threshold& threshold);

/// Reads "3.5" (in the field's unit) or "0.1%" (of the field's range). Throws InvalidArgument naming `what`
/// for anything else, and if the value is negative or not finite.
Threshold parse_threshold(std::string_view text, std::string_view what);

}  // namespace morsel::persistence
