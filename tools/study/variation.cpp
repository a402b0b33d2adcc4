#include "morsel/tools/study/variation.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_set>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/specification.h"

namespace morsel::tools {
namespace {

constexpr double kMet = 1e-9;  // share of a step within which the end of a range counts as met

struct Quantity {
  double number = 0;
  std::string unit;
};

/// A number with letters or % behind it.
std::optional<Quantity> parse_quantity(std::string_view text) {
  Quantity quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error != std::errc() || !std::isfinite(quantity.number)) return std::nullopt;
  quantity.unit = text.substr(static_cast<std::size_t>(end - text.data()));
  const auto is_unit = [](char c) { return c == '%' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (const char c : quantity.unit)
    if (!is_unit(c)) return std::nullopt;
  return quantity;
}

std::string written(double number, const std::string& unit) {
  return core::to_digits(number, 12) + unit;  // hides that 0.1 + 0.2 is not 0.3
}

/// The parts of a text between "..".
std::vector<std::string_view> split_range(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t dots; (dots = text.find("..")) != std::string_view::npos; text.remove_prefix(dots + 2))
    parts.push_back(text.substr(0, dots));
  parts.push_back(text);
  return parts;
}

class VariationReader {
 public:
  explicit VariationReader(std::string_view text) : text_(text) {}

  Variation read() {
    const std::vector<std::string_view> sides = core::split_unescaped(text_, '=');
    if (sides.size() < 2) throw refused("has no values");
    variation_.key = core::unescape(sides.front());
    if (variation_.key.empty()) throw refused("has no key");
    for (const std::string_view value : core::split_unescaped(text_.substr(sides.front().size() + 1), ','))
      add_all(value);
    return std::move(variation_);
  }

 private:
  core::InvalidArgument refused(const std::string& why) const {
    return core::InvalidArgument("the variation \"" + std::string(text_) + "\" " + why +
                                 "; it is written KEY=VALUE,VALUE or KEY=A..B, A..B..STEP, A..B..xFACTOR");
  }

  void add(std::string value) {
    if (!seen_.insert(value).second) throw refused("has the value " + value + " twice");
    if (variation_.values.size() == kMostValues)
      throw refused("has more than " + std::to_string(kMostValues) + " values");
    variation_.values.push_back(std::move(value));
  }

  void add_all(std::string_view value) {
    if (value.empty()) throw refused("has an empty value");
    const std::vector<std::string_view> parts = split_range(value);
    const std::optional<Quantity> first = parse_quantity(parts.front());
    if (parts.size() == 1 || !first) {
      add(std::string(value));
      return;
    }
    const std::optional<Quantity> last = parse_quantity(parts[1]);
    const bool by_factor = parts.size() == 3 && parts[2].starts_with('x');
    const std::optional<Quantity> step = parts.size() == 2 ? Quantity{1, ""}
                                         : by_factor       ? parse_quantity(parts[2].substr(1))
                                                           : parse_quantity(parts[2]);
    if (parts.size() > 3 || !last || !step || (by_factor && !step->unit.empty()))
      throw refused("has " + std::string(value) + ", which is no range of numbers");
    std::string unit;
    for (const Quantity* quantity : {&*first, &*last, &*step}) {
      if (quantity->unit.empty()) continue;
      if (!unit.empty() && unit != quantity->unit)
        throw refused("has " + std::string(value) + " with two units, " + unit + " and " + quantity->unit);
      unit = quantity->unit;
    }
    if (by_factor)
      add_powers(first->number, last->number, step->number, unit);
    else
      add_multiples(first->number, last->number, step->number, unit);
  }

  void add_multiples(double first, double last, double step, const std::string& unit) {
    const double size = std::abs(step);
    if (!(size > 0)) throw refused("has a range with a step of 0");
    const double signed_step = last < first ? -size : size;
    const double steps = std::abs(last - first) / size;
    check(steps);
    for (std::size_t i = 0; static_cast<double>(i) <= steps + kMet; ++i)
      add(written(first + static_cast<double>(i) * signed_step, unit));
  }

  void add_powers(double first, double last, double factor, const std::string& unit) {
    if (!(first * last > 0) || !(factor > 1))
      throw refused(
          "has a range by factors, of which both ends must have one sign and the factor be above 1");
    const double signed_log = std::abs(last) < std::abs(first) ? -std::log(factor) : std::log(factor);
    const double steps = std::log(last / first) / signed_log;
    check(steps);
    for (std::size_t i = 0; static_cast<double>(i) <= steps + kMet; ++i)
      add(written(first * std::exp(static_cast<double>(i) * signed_log), unit));
  }

  void check(double steps) const {
    if (!(steps < static_cast<double>(kMostValues)))
      throw refused("has more than " + std::to_string(kMostValues) + " values");
  }

  std::string_view text_;
  Variation variation_;
  std::unordered_set<std::string> seen_;
};

}  // namespace

Variation parse_variation(std::string_view text) { return VariationReader(text).read(); }

std::vector<double> numbers_of(const std::vector<std::string>& values, std::string& unit) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    const std::optional<Quantity> quantity = parse_quantity(value);
    if (!quantity || (!numbers.empty() && quantity->unit != unit)) return {};
    unit = quantity->unit;
    numbers.push_back(quantity->number);
  }
  return numbers;
}

}  // namespace morsel::tools
