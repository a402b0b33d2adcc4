#include "morsel/tools/color/value_scale.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools {
namespace {

/// The percentile of the values: a share of them lies below.
double quantile(std::vector<double>& values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(std::llround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

std::optional<double> choose_center(std::vector<double>& values, const ScaleRequest& request) {
  using Center = ScaleRequest::Center;
  switch (request.center) {
    case Center::zero:
      return 0;
    case Center::median:
      return quantile(values, 0.5);
    case Center::none:
      return std::nullopt;
    case Center::automatic:
      break;
  }
  if (request.limits) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  const auto below =
      static_cast<double>(std::count_if(values.begin(), values.end(), [](double x) { return x < 0; }));
  const auto above =
      static_cast<double>(std::count_if(values.begin(), values.end(), [](double x) { return x > 0; }));
  if (below == 0 || above == 0) return std::nullopt;
  return std::min(below, above) > 0.1 * n ? 0 : quantile(values, 0.5);
}

}  // namespace

void parse_range(std::string_view text, ScaleRequest& request) {
  if (text.ends_with('%')) {
    request.clip = core::parse_number(text.substr(0, text.size() - 1), "the percentage of a range");
    if (!(request.clip >= 0 && request.clip < 50))
      throw core::InvalidArgument("a range cuts off 0 % to less than 50 % at either end, not " +
                                  std::string(text));
    return;
  }
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos)
    throw core::InvalidArgument("a range is LOW/HIGH in the field's unit, or a percentage such as 2%, not '" +
                                std::string(text) + "'");
  const double low = core::parse_number(text.substr(0, slash), "the lower end of a range");
  const double high = core::parse_number(text.substr(slash + 1), "the upper end of a range");
  if (!(low < high))
    throw core::InvalidArgument("a range's lower end must be below its upper one, not " + std::string(text));
  request.limits = {low, high};
}

ValueScale choose_scale(std::span<const double> given, const ScaleRequest& request) {
  if (given.empty()) throw core::InvalidArgument("no values to choose colours for");
  std::vector<double> values(given.begin(), given.end());
  const auto [least, largest] = std::minmax_element(given.begin(), given.end());
  const std::optional<double> center = choose_center(values, request);
  double low = 0, high = 0;
  if (request.limits) {
    std::tie(low, high) = *request.limits;
  } else {
    low = quantile(values, request.clip / 100);
    high = quantile(values, 1 - request.clip / 100);
  }
  if (center) {
    const double reach = std::max(std::abs(high - *center), std::abs(low - *center));
    low = *center - reach;
    high = *center + reach;
  }
  if (!(low < high)) {
    const double reach = std::max(std::abs(low), 1.) * 0.5;
    low -= reach;
    high += reach;
  }
  if (!std::isfinite(high - low))
    throw core::InvalidArgument("the field's values span more than a double can hold; give a range");
  const bool diverging =
      center.has_value() || (request.limits && request.limits->first == -request.limits->second);
  Colormap map(!request.colormap.empty() ? request.colormap : diverging ? "blue-orange" : "sand");
  return {std::move(map), low, high, center, *least<low, *largest> high};
}

}  // namespace morsel::tools
