#pragma once
/// Where an axis is marked and with which numbers.

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
  /// What the numbers leave out, if they would be too long: value = (number · 10^factor) + offset.
  int factor = 0;
  double offset = 0;
  std::string offset_text = {};  ///< of the offset; empty if it is 0
};

/// An interval to show values of `data` in: with air at both ends, and of some size even if all are equal. On
/// a logarithmic axis the ends are positive.
Interval padded(Interval data, const Axis& axis);

/// What grows evenly along the axis.
double along(double value, const Axis& axis);

/// Multiples of 1, 2 or 5 times a power of ten within `shown`, at most `count` + 1 of them (or 5). On a
/// logarithmic axis powers of ten, not all of them if they are more than `count`; with few powers in the
/// interval also their multiples by 2 and 5, and as on a linear axis where even these are few. On a symmetric
/// axis 0 and powers of ten of both signs, from where it ceases to be linear on, or as on a linear axis if
/// these are few. On an axis of names, these. `shown` is as padded() makes it: finite, lower < upper,
/// positive on a logarithmic axis.
Ticks make_ticks(Interval shown, const Axis& axis, int count);

/// 10⁻³ for −3.
std::string power_of_ten(int exponent);

}  // namespace morsel::tools::plot
