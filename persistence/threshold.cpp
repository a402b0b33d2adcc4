#include "morsel/persistence/threshold.h"

#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"

namespace morsel::persistence {

double Threshold::on(const core::ScalarField& field) const {
  if (!std::isfinite(value) || value < 0)
    throw core::InvalidArgument("a persistence threshold must be a finite number of at least 0, not " +
                                to_string(*this));
  if (!in_percent) return value;
  const double share = value / 100;
  const double extent = field.extent();
  // The range of a field that spans more than half of all doubles overflows, a share of it need not.
  return std::isfinite(extent) ? share * extent : share * field.max() - share * field.min();
}

std::string to_string(const Threshold& threshold) {
  return core::shortest(threshold.value) + (threshold.in_percent ? "%" : "");
}

Threshold parse_threshold(std::string_view text, std::string_view what) {
  const std::string_view whole = text;
  Threshold result{0, text.ends_with('%')};
  if (result.in_percent) text.remove_suffix(1);
  bool valid = true;
  try {
    result.value = core::parse_number(text, what);
  } catch (const core::InvalidArgument&) {
    valid = false;
  }
  if (!valid || result.value < 0)
    throw core::InvalidArgument(std::string(what) +
                                " must be a number of at least 0 such as 3.5 (in the field's unit) or 0.1% "
                                "(of the field's range), not \"" +
                                std::string(whole) + "\"");
  return result;
}

}  // namespace morsel::persistence
