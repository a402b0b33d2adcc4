#include "morsel/morse/smoothing/saliency.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/smoothing/ball_keys.h"
#include "morsel/morse/smoothing/keep_order.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Length;
using core::ScalarField;

void check(const SaliencyOptions& options) {
  if (options.scales.empty()) throw core::InvalidArgument("mesh saliency needs at least one scale");
  for (const Length& scale : options.scales)
    if (!(scale.value > 0) || !std::isfinite(scale.value))
      throw core::InvalidArgument("scales must be finite and above 0, not " + core::to_string(scale));
}

/// The mean of the local maxima of a map but for the highest; 0 if there is no other.
double mean_of_other_maxima(const ScalarField& map) {
  const Index highest = map.order().back();
  struct Sum {
    double value = 0;
    std::size_t count = 0;
  };
  const Sum sum = core::parallel_reduce(
      0, map.values().size(), core::kGrain, Sum(),
      [&](std::size_t first, std::size_t last) {
        Sum part;
        for (std::size_t i = first; i < last; ++i) {
          const auto v = static_cast<Index>(i);
          bool is_maximum = v != highest;
          core::for_each_neighbor(map.mesh(), v, [&](Index u) { is_maximum &= map.is_lower(u, v); });
          if (!is_maximum) continue;
          part.value += map.value(v);
          ++part.count;
        }
        return part;
      },
      [](Sum a, const Sum& b) {
        return Sum{a.value + b.value, a.count + b.count};
      });
  return sum.count > 0 ? sum.value / static_cast<double>(sum.count) : 0;
}

/// Scales a map to [0, 1] and multiplies it by the factor that it returns.
double suppress(const ScalarField& input, std::vector<double>& map) {
  const auto [least, most] = std::minmax_element(map.begin(), map.end());
  const double base = *least;
  const double extent = *most - base;
  if (!(extent > 0)) {
    std::fill(map.begin(), map.end(), 0.0);
    return 0;
  }
  core::parallel_for_each(map.size(), [&](std::size_t v) { map[v] = (map[v] - base) / extent; });
  const double distance = 1 - mean_of_other_maxima(keep_order(input, map));
  const double factor = distance * distance;
  core::parallel_for_each(map.size(), [&](std::size_t v) { map[v] *= factor; });
  return factor;
}

/// Lengths as a list key takes them.
std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : "/") + core::shortest(value);
  return text;
}

class Saliency final : public core::Method {
 public:
  explicit Saliency(SaliencyOptions options) : options_(std::move(options)) {}

  core::MethodResult apply(const ScalarField& input, const core::MethodContext& context) const override {
    SaliencyResult result = saliency(input, options_, context.progress);
    const bool suppressed = options_.suppression == Suppression::itti;
    return {std::move(result.field),
            {{"scales", joined(result.scales)},
             {"suppression", suppressed ? "itti" : "none"},
             {"support", options_.support},
             {"weights", std::string(to_string(options_.weights))},
             {"ball", std::string(to_string(options_.ball))}},
            {{"factors", joined(result.factors)}}};
  }
  core::MethodTraits traits() const override { return {.quantity = "saliency"}; }

 private:
  SaliencyOptions options_;
};

}  // namespace

SaliencyResult saliency(const ScalarField& input, const SaliencyOptions& options,
                        const core::Progress& progress) {
  check(options);
  std::map<double, Length> sigmas;  // scales share some: 2 · 2ε is 4ε, to the last digit
  for (const Length& scale : options.scales)
    for (const double factor : {1.0, 2.0}) {
      const Length length{factor * scale.value, scale.unit};
      sigmas.emplace(length.on(input.mesh()), length);
    }
  std::map<double, ScalarField> averages;
  for (const auto& [sigma, length] : sigmas) {
    const core::Progress part([&](std::string_view, double fraction) {
      const auto done = static_cast<double>(averages.size()) + fraction;
      progress.update("saliency", std::min(1.0, done / static_cast<double>(sigmas.size())));
    });
    averages.emplace(sigma,
                     gaussian(input, {1, length, options.support, options.weights, options.ball}, part));
  }
  SaliencyResult result{input, {}, {}};
  std::vector<double> sum(input.values().size(), 0.0);
  std::vector<double> map(sum.size());
  for (const Length& scale : options.scales) {
    const double sigma = scale.on(input.mesh());
    const std::span<const double> fine = averages.at(sigma).values();
    const std::span<const double> coarse = averages.at(2 * sigma).values();
    core::parallel_for_each(map.size(), [&](std::size_t v) { map[v] = std::abs(fine[v] - coarse[v]); });
    result.scales.push_back(sigma);
    result.factors.push_back(options.suppression == Suppression::itti ? suppress(input, map) : 1);
    core::parallel_for_each(map.size(), [&](std::size_t v) { sum[v] += map[v]; });
  }
  result.field = keep_order(input, std::move(sum));
  progress.update("saliency", 1);
  return result;
}

std::vector<Length> published_scales() {
  return {Length::epsilons(2), Length::epsilons(3), Length::epsilons(4), Length::epsilons(5),
          Length::epsilons(6)};
}

std::unique_ptr<core::Method> make_saliency(core::ParameterReader& reader) {
  SaliencyOptions options;
  std::string scales;
  for (const Length& scale : options.scales) scales += (scales.empty() ? "" : "/") + core::to_string(scale);
  options.scales.clear();
  for (const std::string& scale :
       reader.list("scales", scales.c_str(),
                   "sigma of each map, compared with the average at twice that; Lee et al. have "
                   "2eps/3eps/4eps/5eps/6eps"))
    options.scales.push_back(core::parse_length(scale, reader.owner() + ":scales"));
  if (reader.choice("suppression", "itti", {"itti", "none"},
                    "itti: maps with one high peak count more than those with many (Itti et al. 1998)") ==
      "none")
    options.suppression = Suppression::none;
  SalientOptions shared;
  read_support(reader, shared);
  read_neighbors(reader, shared);
  options.support = shared.support;
  options.weights = shared.weights;
  options.ball = shared.ball;
  check(options);
  return std::make_unique<Saliency>(std::move(options));
}

}  // namespace morsel::morse
