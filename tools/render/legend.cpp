#include "morsel/tools/render/legend.h"

#include <algorithm>
#include <cmath>

#include "morsel/core/text/numbers.h"

namespace morsel::tools::render {
namespace {

double step_of(const std::vector<double>& at) { return at.size() > 1 ? at[1] - at[0] : 0; }

struct Measures {
  double bar;     // width
  double tick;    // length of a tick, and the gap to its text
  double margin;  // at the right
};
Measures measures(double em) { return {1.05 * em, 0.35 * em, 0.9 * em}; }

}  // namespace

Quantity quantity_of(const std::string& function, const std::string& unit, const std::string& made) {
  Quantity quantity = made.empty() ? Quantity{function, unit} : Quantity{made + " of " + function, ""};
  std::replace(quantity.words.begin(), quantity.words.end(), '-', ' ');
  return quantity;
}

std::vector<double> ticks(double low, double high) {
  const double raw = (high - low) / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {1., 2., 5.})
    if (factor * power >= raw * 0.9) {
      step = factor * power;
      break;
    }
  std::vector<double> at;
  const double slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack && at.size() < 9; ++k)
    at.push_back(k * step);
  return at;
}

std::string tick_text(double value, double step) {
  const double largest = std::max(std::abs(value), step);
  if (value == 0) return "0";
  const int decimals = step > 0 ? std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))) : 3;
  std::string result =
      largest >= 1e6 || largest < 1e-4 ? core::to_digits(value, 3) : core::to_decimals(value, decimals);
  for (std::size_t at = 0; (at = result.find('-', at)) != std::string::npos;) result.replace(at, 1, "\u2212");
  return result;
}

int legend_width(Canvas& canvas, const ValueScale& scale, const Quantity& quantity, double em) {
  const Measures m = measures(em);
  const std::vector<double> at = ticks(scale.low, scale.high);
  double widest = 0;
  for (const double t : at) widest = std::max(widest, canvas.text_width(0.9 * em, tick_text(t, step_of(at))));
  const double beside = m.bar + 2 * m.tick + widest;
  const double above =
      std::max(canvas.text_width(0.9 * em, quantity.words), canvas.text_width(0.9 * em, quantity.unit));
  return static_cast<int>(std::ceil(std::max(beside, above) + m.margin));
}

void draw_legend(Canvas& canvas, const ValueScale& scale, const Quantity& quantity, double em, double x,
                 double height) {
  const Measures m = measures(em);
  const double letters = 0.9 * em;
  const double length = std::round(0.46 * height);
  const double lines = (quantity.unit.empty() ? 1 : 2) * 1.3 * em;
  const double top = std::round((height - length + lines) / 2);
  const double bottom = top + length;
  const double arrow = 0.75 * m.bar;

  double line = top - arrow - 0.6 * em - lines + 1.3 * em;
  canvas.text(x, line, letters, quantity.words);
  if (!quantity.unit.empty())
    canvas.text(x, line + 1.25 * em, letters, "[" + quantity.unit + "]", Align::left, kGray);

  canvas.ramp(scale.map, x, top, m.bar, length);
  if (scale.clipped_above)
    canvas.fill_triangle({x, x + m.bar, x + m.bar / 2}, {top, top, top - arrow}, scale.map(1));
  if (scale.clipped_below)
    canvas.fill_triangle({x, x + m.bar, x + m.bar / 2}, {bottom, bottom, bottom + arrow}, scale.map(0));
  const std::vector<double> at = ticks(scale.low, scale.high);
  for (const double t : at) {
    const double y = bottom - scale.position(t) * length;
    canvas.line(x + m.bar, y, x + m.bar + m.tick, y, std::max(1., 0.07 * em), kGray);
    canvas.text(x + m.bar + 2 * m.tick, y + 0.33 * em, letters, tick_text(t, step_of(at)));
  }
}

}  // namespace morsel::tools::render
