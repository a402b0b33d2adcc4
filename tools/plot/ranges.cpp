#include "morsel/tools/plot/ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "morsel/core/error.h"

namespace morsel::tools::plot {
namespace {

constexpr double kLargest = 1e300;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const std::string& why) {
  throw core::InvalidArgument("cannot draw a plot: " + why);
}

/// The smallest interval with all that was added; nothing is added yet if lower > upper.
struct Bounds {
  double lower = kInfinity;
  double upper = -kInfinity;
  void add(double value) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  void add(const Bounds& other) {
    lower = std::min(lower, other.lower);
    upper = std::max(upper, other.upper);
  }
};

void check_value(double value, const Axis& axis, const Series& series, std::size_t i) {
  const auto where = [&] {
    return " at point " + std::to_string(i) + " of the series '" + series.name + "'";
  };
  if (!(std::abs(value) <= kLargest)) refuse("a value that is not finite or beyond 1e300" + where());
  if (axis.scale == Scale::log && value <= 0)
    refuse("a value of 0 or less" + where() + ", which a logarithmic axis does not have");
}

Interval shown(const Bounds& data, const Axis& axis) {
  const bool log = axis.scale == Scale::log;
  if (axis.scale == Scale::symmetric && !(axis.linear > 0 && axis.linear <= kLargest))
    refuse("the linear part of the axis '" + axis.label + "' is not a positive number");
  for (const std::optional<double>& limit : {axis.lower, axis.upper})
    if (limit && (!(std::abs(*limit) <= kLargest) || (log && *limit <= 0)))
      refuse("a limit of the axis '" + axis.label +
             "' is not finite, beyond 1e300, or 0 or less with a logarithmic scale");
  if (!axis.names.empty()) {
    if (axis.scale != Scale::linear) refuse("the axis '" + axis.label + "' has names, but is not linear");
    return {axis.lower.value_or(-0.5), axis.upper.value_or(static_cast<double>(axis.names.size()) - 0.5)};
  }
  const bool empty = data.lower > data.upper;
  Interval interval =
      empty ? (log ? Interval{1, 10} : Interval{0, 1}) : padded({data.lower, data.upper}, axis);
  const auto beyond = [&](double limit, double sign) {  // if the other limit excludes all data
    return log ? limit * std::pow(10, sign) : limit + sign * std::max(1., std::abs(limit));
  };
  if (axis.lower) interval.lower = *axis.lower;
  if (axis.upper) interval.upper = *axis.upper;
  if (axis.lower && !axis.upper && interval.upper <= interval.lower)
    interval.upper = beyond(interval.lower, 1);
  if (axis.upper && !axis.lower && interval.lower >= interval.upper)
    interval.lower = beyond(interval.upper, -1);
  const double largest = std::max(std::abs(interval.lower), std::abs(interval.upper));
  if (!(interval.size() > 1e-13 * largest))
    refuse("the limits of the axis '" + axis.label + "' are no interval, or one too short for its place");
  return interval;
}

}  // namespace

Ranges ranges_of(const Plot& plot) {
  if (plot.panels.empty()) refuse("it has no panel");
  if (plot.columns < 1) refuse("its panels have 0 columns");
  if (!(plot.width >= 100 && plot.width <= 2000)) refuse("its width is not from 100 to 2000 points");
  if (plot.diagonal && (plot.x.scale != plot.y.scale || plot.x.linear != plot.y.linear ||
                        plot.x.lower != plot.y.lower || plot.x.upper != plot.y.upper))
    refuse("with a diagonal both axes have the same scale and limits");
  Ranges ranges;
  Bounds x, y;
  for (const Panel& panel : plot.panels)
    for (const Series& series : panel.series) {
      if (series.x.size() != series.y.size())
        refuse("the series '" + series.name + "' has " + std::to_string(series.x.size()) + " x and " +
               std::to_string(series.y.size()) + " y");
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        check_value(series.x[i], plot.x, series, i);
        x.add(series.x[i]);
        if (series.draw == Draw::marks && series.y[i] == kInfinity) {
          ranges.infinity = true;
          continue;
        }
        check_value(series.y[i], plot.y, series, i);
        y.add(series.y[i]);
      }
    }
  if (plot.diagonal) {
    x.add(y);
    y = x;
  }
  ranges.x = shown(x, plot.x);
  ranges.y = shown(y, plot.y);
  return ranges;
}

}  // namespace morsel::tools::plot
