#pragma once
/// The ticks of an axis and their numbers.

#include <string>
#include <vector>

#include "morsel/tools/plot/plot.h"

namespace morsel::tools::plot {

struct Interval {
  double lower = 0;
  double upper = 0;
  double size() const { return upper - lower; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A marked value and its number; powers as "10⁻³".
struct Tick {
  double value = 0;
  std::string label = {};
  friend bool operator==(const Tick&, const Tick&) = default;
};

struct Ticks {
  std::vector<Tick> major;    ///< ascending
  std::vector<double> minor;  ///< ascending; without numbers
  /// The factor and offset that the numbers leave out, if they would be too long: value = (number ·
  /// 10^factor) + offset.
  int factor = 0;
  double offset = 0;
  std::string offset_text = {};  ///< of the offset; empty if it is 0
};

/// The interval that an axis shows for `data`: with a margin at both ends, and not empty even if all values
/// are equal. On a logarithmic axis the ends are positive.
Interval padded(Interval data, const Axis& axis);

/// The value transformed by the axis's scale, which is linear along the axis.
double along(double value, const Axis& axis);

/// Multiples of 1, 2 or 5 times a power of ten within `shown`, at most `count` + 1 of them (or 5). On a
/// logarithmic axis powers of ten, not all of them if they are more than `count`; with few powers in the
/// interval also their multiples by 2 and 5, and as on a linear axis where even these are few. On a symmetric
/// axis 0 and powers of ten of both signs, beyond its linear part, or as on a linear axis if these are few.
/// On an axis of names, the names. `shown` is as padded() makes it: finite, lower < upper, positive on a
/// logarithmic axis.
Ticks make_ticks(Interval shown, const Axis& axis, int count);

/// 10⁻³ for −3.
std::string power_of_ten(int exponent);

}  // namespace morsel::tools::plot
