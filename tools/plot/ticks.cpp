#include "morsel/tools/plot/ticks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "morsel/core/text/numbers.h"

namespace morsel::tools::plot {
namespace {

constexpr double kPadding = 0.04;     // of an interval, at each end
constexpr double kSameValue = 1e-12;  // differences below this share of the values are not resolved
constexpr double kNothing = 1e-290;   // values below are taken for 0
constexpr int kMostDigits = 5;        // before the decimal point
constexpr const char* kMinus = "\u2212";

/// number · 10^exponent, rounded correctly.
double parse(std::int64_t number, int exponent) {
  const std::string text = std::to_string(number) + "e" + std::to_string(exponent);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

int digits_of(std::int64_t number) { return static_cast<int>(std::to_string(std::abs(number)).size()); }

/// number · 10^exponent written out, with −exponent decimals if it is negative.
std::string decimal(std::int64_t number, int exponent) {
  std::string digits = std::to_string(std::abs(number));
  std::string fraction;
  if (exponent >= 0) {
    if (number != 0) digits.append(static_cast<std::size_t>(exponent), '0');
  } else {
    const auto decimals = static_cast<std::size_t>(-exponent);
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    fraction = "." + digits.substr(digits.size() - decimals);
    digits.resize(digits.size() - decimals);
  }
  return (number < 0 ? kMinus : "") + core::grouped_digits(digits) + fraction;
}

/// The step between marks, multiple · 10^exponent.
struct Step {
  int multiple = 1;
  int exponent = 0;
  double size() const { return parse(multiple, exponent); }
};

Step step_for(double size, int count) {
  const double least = size / count * (1 - 1e-9);
  Step step{1, static_cast<int>(std::floor(std::log10(least)))};
  while (step.size() > least) --step.exponent;
  for (;; ++step.exponent)
    for (const int multiple : {1, 2, 5}) {
      step.multiple = multiple;
      if (step.size() >= least) return step;
    }
}

Ticks linear_ticks(Interval shown, int count) {
  Step step;
  std::int64_t first = 0, last = 0;
  do {  // a step may be longer than the interval, and none of its multiples within
    step = step_for(shown.size(), count++);
    const double lower = shown.lower / step.size(), upper = shown.upper / step.size();
    const double rounding = std::max(1e-6, 1e-15 * std::max(std::abs(lower), std::abs(upper)));
    first = static_cast<std::int64_t>(std::ceil(lower - rounding));
    last = static_cast<std::int64_t>(std::floor(upper + rounding));
  } while (last <= first);

  Ticks ticks;
  std::int64_t offset = 0;
  const std::int64_t spread = (last - first) * step.multiple;
  const std::int64_t largest = std::max(std::abs(first), std::abs(last)) * step.multiple;
  if (digits_of(largest) - digits_of(spread) >= 4) {
    std::int64_t unit = 1;
    for (int i = 0; i < digits_of(spread); ++i) unit *= 10;
    offset = first * step.multiple / unit * unit;
    ticks.offset = parse(offset, step.exponent);
    // Without trailing zeros.
    std::int64_t number = offset;
    int exponent = step.exponent;
    for (; exponent < 0 && number % 10 == 0; ++exponent) number /= 10;
    ticks.offset_text = decimal(number, exponent);
  }
  const std::int64_t longest =
      std::max(std::abs(first * step.multiple - offset), std::abs(last * step.multiple - offset));
  const int magnitude = digits_of(longest) - 1 + step.exponent;
  if (magnitude >= kMostDigits || magnitude < -3) ticks.factor = magnitude;
  for (std::int64_t k = first; k <= last; ++k)
    ticks.major.push_back({parse(k * step.multiple, step.exponent),
                           decimal(k * step.multiple - offset, step.exponent - ticks.factor)});
  return ticks;
}

/// Whether the powers of ten from one to the other are written as numbers.
bool is_plain(int first_power, int last_power) { return first_power >= -2 && last_power < kMostDigits; }

Tick log_tick(int multiple, int power, bool plain) {
  if (plain) return {parse(multiple, power), decimal(multiple, power)};
  const std::string times = multiple == 1 ? "" : std::to_string(multiple) + "\u00b7";
  return {parse(multiple, power), times + power_of_ten(power)};
}

Ticks log_ticks(Interval shown, int count) {
  const auto within = [&](double value) {
    return value >= shown.lower * (1 - 1e-9) && value <= shown.upper * (1 + 1e-9);
  };
  const int low = static_cast<int>(std::floor(std::log10(shown.lower))) - 1;
  const int high = static_cast<int>(std::ceil(std::log10(shown.upper))) + 1;
  std::vector<int> powers;
  for (int p = low; p <= high; ++p)
    if (within(parse(1, p))) powers.push_back(p);

  Ticks ticks;
  const auto add_minor = [&](int multiple, int power) {
    if (within(parse(multiple, power))) ticks.minor.push_back(parse(multiple, power));
  };
  if (powers.size() > 2) {
    const int stride = std::max(1, (static_cast<int>(powers.size()) - 1 + count - 1) / count);
    const auto labelled = [&](int p) { return (p % stride + stride) % stride == 0; };
    const bool plain = is_plain(powers.front(), powers.back());
    for (int p = low; p <= high; ++p) {
      if (within(parse(1, p))) {
        if (labelled(p))
          ticks.major.push_back(log_tick(1, p, plain));
        else
          ticks.minor.push_back(parse(1, p));
      }
      for (int m = 2; stride == 1 && m < 10; ++m) add_minor(m, p);
    }
    return ticks;
  }
  const bool plain = low >= -4 && high <= kMostDigits;
  for (int p = low; p <= high; ++p)
    for (int m = 1; m < 10; ++m) {
      if (m == 1 || m == 2 || m == 5) {
        if (within(parse(m, p))) ticks.major.push_back(log_tick(m, p, plain));
      } else {
        add_minor(m, p);
      }
    }
  if (ticks.major.size() < 3) return linear_ticks(shown, count);
  if (ticks.major.size() > static_cast<std::size_t>(count) + 1 &&
      powers.size() == 2)  // then the powers suffice
    std::erase_if(ticks.major, [&](const Tick& tick) {
      const bool power = tick.value == parse(1, powers[0]) || tick.value == parse(1, powers[1]);
      if (!power) ticks.minor.push_back(tick.value);
      return !power;
    });
  std::sort(ticks.minor.begin(), ticks.minor.end());
  return ticks;
}

/// Powers of ten of both signs from `linear` on, every so many of them, and 0.
Ticks symmetric_ticks(Interval shown, double linear, int count) {
  const int low = static_cast<int>(std::ceil(std::log10(linear) - 1e-9));
  const int high = static_cast<int>(std::floor(std::log10(std::max(-shown.lower, shown.upper)) + 1e-9));
  const auto within = [&](double value) { return value >= shown.lower && value <= shown.upper; };
  Ticks ticks;
  // Reduces their number: those at the ends of the linear part are dropped before the step is made larger.
  for (int attempt = 2; attempt / 2 <= std::max(1, high - low + 1); ++attempt) {
    const int stride = attempt / 2, first = low + attempt % 2;
    ticks = {};
    const auto side = [&](int sign) {
      for (int i = low; i <= high; ++i) {
        const int power = sign > 0 ? i : high - (i - low);
        for (int k = 1; k < 10; ++k) {
          const int multiple = sign > 0 ? k : 10 - k;
          const double value = sign * parse(multiple, power);
          if (!within(value)) continue;
          if (multiple == 1 && power >= first && (high - power) % stride == 0) {
            Tick tick = log_tick(1, power, is_plain(low, high) && high < 3);
            tick.value = value;
            if (sign < 0) tick.label.insert(0, kMinus);
            ticks.major.push_back(std::move(tick));
          } else if (multiple == 1 || stride == 1) {
            ticks.minor.push_back(value);
          }
        }
      }
    };
    side(-1);
    if (within(0)) ticks.major.push_back({0, "0"});
    side(1);
    if (attempt == 2 && ticks.major.size() < 3) return linear_ticks(shown, count);
    if (ticks.major.size() <= static_cast<std::size_t>(count) + 1) break;
  }
  return ticks;
}

Ticks name_ticks(Interval shown, const std::vector<std::string>& names) {
  Ticks ticks;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto place = static_cast<double>(i); place >= shown.lower && place <= shown.upper)
      ticks.major.push_back({place, names[i]});
  return ticks;
}

}  // namespace

std::string power_of_ten(int exponent) {
  constexpr const char* kRaised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                     "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = exponent < 0 ? "10\u207b" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[digit - '0'];
  return text;
}

double along(double value, const Axis& axis) {
  switch (axis.scale) {
    case Scale::log:
      return std::log(value);
    case Scale::symmetric:
      return std::asinh(value / axis.linear);
    case Scale::linear:
      break;
  }
  return value;
}

Interval padded(Interval data, const Axis& axis) {
  const double largest = std::max(std::abs(data.lower), std::abs(data.upper));
  const bool constant = data.size() <= std::max(kSameValue * largest, kNothing);
  if (axis.scale == Scale::log) {
    if (constant) return {data.lower / 2, data.upper * 2};
    const double factor = std::pow(data.upper / data.lower, kPadding);
    return {data.lower / factor, data.upper * factor};
  }
  if (constant && largest <= kNothing) return {-1, 1};
  if (axis.scale == Scale::symmetric && !constant) {
    const double lower = along(data.lower, axis), upper = along(data.upper, axis);
    const double padding = kPadding * (upper - lower);
    return {axis.linear * std::sinh(lower - padding), axis.linear * std::sinh(upper + padding)};
  }
  const double padding = constant ? largest / 2 : kPadding * data.size();
  return {data.lower - padding, data.upper + padding};
}

Ticks make_ticks(Interval shown, const Axis& axis, int count) {
  if (!axis.names.empty()) return name_ticks(shown, axis.names);
  switch (axis.scale) {
    case Scale::log:
      return log_ticks(shown, count);
    case Scale::symmetric:
      return symmetric_ticks(shown, axis.linear, count);
    case Scale::linear:
      break;
  }
  return linear_ticks(shown, count);
}

}  // namespace morsel::tools::plot
