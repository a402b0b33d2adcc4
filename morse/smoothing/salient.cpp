#include "morsel/morse/smoothing/salient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel.h"
#include "morsel/morse/smoothing/keep_order.h"
#include "morsel/morse/smoothing/neighborhoods.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::InvalidArgument;

/// The population's standard deviation; exactly 0 for a constant. Values are of order 1.
double standard_deviation(std::span<const double> values) {
  const double base = *std::min_element(values.begin(), values.end());
  const auto sum = [&](const auto& term) {
    return core::parallel_reduce(
        0, values.size(), core::kGrain, 0.0,
        [&](std::size_t first, std::size_t last) {
          double part = 0;
          for (std::size_t v = first; v < last; ++v) part += term(values[v] - base);
          return part;
        },
        [](double a, double b) { return a + b; });
  };
  const auto n = static_cast<double>(values.size());
  const double mean = sum([](double g) { return g; }) / n;
  return std::sqrt(sum([&](double g) { return (g - mean) * (g - mean); }) / n);
}

/// All that an iteration reads of a vertex, side by side.
struct Sample {
  double x, y, z, value;
};

class Filter {
 public:
  Filter(const core::ScalarField& input, const SalientOptions& options, double sigma,
         const core::Progress& progress)
      : options_(options),
        progress_(progress),
        per_sigma_(1 / sigma),
        neighborhoods_(input.mesh().positions(), options.support * sigma,
                       options.iterations > 1 ? options.memory : 0, progress) {
    const std::size_t n = input.values().size();
    const double largest = std::max(std::abs(input.min()), std::abs(input.max()));
    // A power of two changes no digit, and keeps differences and squares in range.
    exponent_ = largest > 0 ? std::ilogb(largest) : 0;
    samples_.resize(n);
    values_.resize(n);
    saliency_.assign(n, 0.0);
    for (std::size_t v = 0; v < n; ++v) {
      const core::Point& p = input.mesh().position(static_cast<Index>(v));
      values_[v] = std::ldexp(input.values()[v], -exponent_);
      samples_[v] = {p.x(), p.y(), p.z(), values_[v]};
    }
    const ValueRange& range = options.range;
    if (range.kind == ValueRange::Kind::local) return;
    if (range.kind == ValueRange::Kind::deviations) {
      scaled_sigma_s_ = range.value * standard_deviation(values_);
      sigma_s_ = std::ldexp(scaled_sigma_s_, exponent_);
    } else {
      sigma_s_ = range.kind == ValueRange::Kind::literal ? sigma : range.value;
      scaled_sigma_s_ = std::ldexp(*sigma_s_, -exponent_);
    }
  }

  std::optional<double> sigma_s() const { return sigma_s_; }
  std::vector<double> values() const { return unscaled(values_); }
  std::vector<double> saliency() const { return unscaled(saliency_); }
  std::uint64_t pairs() const { return pairs_; }

  void iterate(int iteration) {
    // In slabs, so that progress moves and a stop is heard on large meshes too.
    constexpr std::size_t kSlab = 512 * Neighborhoods::kChunk;
    const std::size_t n = samples_.size();
    pairs_ = 0;
    for (std::size_t begin = 0; begin < n; begin += kSlab) {
      const double done = static_cast<double>(begin) / static_cast<double>(n);
      progress_.update("salient smoothing", (iteration + done) / options_.iterations);
      pairs_ += core::parallel_reduce(
          begin, std::min(n, begin + kSlab), Neighborhoods::kChunk, std::uint64_t{0},
          [&](std::size_t first, std::size_t last) {
            progress_.throw_if_cancelled();
            return filter(first, last);
          },
          [](std::uint64_t a, std::uint64_t b) { return a + b; });
    }
    core::parallel_for_each(n, [&](std::size_t v) {
      values_[v] += saliency_[v];
      samples_[v].value = values_[v];
    });
  }

 private:
  /// S for the vertices first … last − 1; returns how many neighbours it visited.
  std::uint64_t filter(std::size_t first, std::size_t last) {
    std::vector<Index> scratch;
    std::uint64_t visited = 0;
    const bool local = !sigma_s_.has_value();
    for (std::size_t v = first; v < last; ++v) {
      const std::span<const Index> ball = neighborhoods_.of(v, scratch);
      visited += ball.size();
      const Sample center = samples_[v];
      const double sigma_s = local ? spread(ball, center.value) : scaled_sigma_s_;
      saliency_[v] = sigma_s > 0 ? average(ball, center, sigma_s) : 0.0;
    }
    return visited;
  }

  double spread(std::span<const Index> ball, double center) const {
    double largest = 0;
    for (const Index x : ball) largest = std::max(largest, std::abs(samples_[x].value - center));
    return largest;
  }

  /// The weighted mean of the differences to the center. Never 0/0: the center itself has weight 1.
  double average(std::span<const Index> ball, const Sample& center, double sigma_s) const {
    double sum = 0;
    double weights = 0;
    for (const Index i : ball) {
      const Sample& x = samples_[i];
      const double dx = (x.x - center.x) * per_sigma_;
      const double dy = (x.y - center.y) * per_sigma_;
      const double dz = (x.z - center.z) * per_sigma_;
      const double difference = x.value - center.value;
      const double t = difference / sigma_s;  // before squaring: a tiny σ_s squared would be 0
      const double exponent = -0.5 * (dx * dx + dy * dy + dz * dz + t * t);
      if (exponent < -746) continue;  // exp is exactly 0 there, and slow to say so
      const double weight = std::exp(exponent);
      sum += difference * weight;
      weights += weight;
    }
    return sum / weights;
  }

  std::vector<double> unscaled(std::vector<double> values) const {
    core::parallel_for_each(values.size(),
                            [&](std::size_t v) { values[v] = std::ldexp(values[v], exponent_); });
    return values;
  }

  const SalientOptions& options_;
  const core::Progress& progress_;
  double per_sigma_;
  Neighborhoods neighborhoods_;
  std::optional<double> sigma_s_;  // none if local
  int exponent_ = 0;               // what follows is the field's, divided by 2^exponent_
  double scaled_sigma_s_ = 0;
  std::vector<double> values_;
  std::vector<double> saliency_;
  std::vector<Sample> samples_;
  std::uint64_t pairs_ = 0;
};

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void check(const SalientOptions& options) {
  if (options.iterations < 0)
    throw InvalidArgument("salient smoothing cannot run " + std::to_string(options.iterations) +
                          " iterations");
  if (options.iterations == 0 && options.return_saliency)
    throw InvalidArgument("there is no saliency without an iteration: iterations must be at least 1");
  if (!is_positive(options.sigma.value))
    throw InvalidArgument("sigma must be finite and above 0, not " + core::to_string(options.sigma));
  if (!is_positive(options.support))
    throw InvalidArgument("support must be finite and above 0, not " + core::shortest(options.support));
  const bool has_value =
      options.range.kind == ValueRange::Kind::deviations || options.range.kind == ValueRange::Kind::fixed;
  if (has_value && !is_positive(options.range.value))
    throw InvalidArgument("range must be finite and above 0, not " + to_string(options.range));
}

double sigma_on(const core::TriangleMesh& mesh, const SalientOptions& options) {
  const double sigma = options.sigma.on(mesh);
  // Below the normal numbers 1/σ has no value.
  if (!(sigma >= std::numeric_limits<double>::min()) || !std::isfinite(options.support * sigma)) {
    const std::string message = "sigma = " + core::to_string(options.sigma) + " comes to " +
                                core::shortest(sigma) +
                                " on this mesh, whose bounding box has the diagonal " +
                                core::shortest(mesh.bounding_box().diagonal());
    if (options.sigma.in_epsilon) throw core::BadInput(message);
    throw InvalidArgument(message);
  }
  return sigma;
}

class Salient final : public core::Method {
 public:
  explicit Salient(SalientOptions options) : options_(std::move(options)) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    const SalientResult result = salient(input, options_, context.progress);
    core::Parameters parameters = {{"iterations", std::int64_t{options_.iterations}},
                                   {"sigma", result.sigma},
                                   {"range", to_string(options_.range)},
                                   {"support", options_.support},
                                   {"classify", options_.return_saliency ? "saliency" : "smoothed"}};
    if (result.sigma_s) parameters.emplace_back("sigma_s", *result.sigma_s);
    return {result.field,
            std::move(parameters),
            {{"pairs_per_iteration", static_cast<std::int64_t>(result.pairs)}}};
  }

 private:
  SalientOptions options_;
};

}  // namespace

ValueRange parse_value_range(std::string_view text, std::string_view what) {
  using Kind = ValueRange::Kind;
  if (text == "local") return {Kind::local, 1};
  if (text == "literal") return {Kind::literal, 1};
  const bool deviations = text.ends_with("std");
  const std::string allowed = std::string(what) + " (or else local, literal or a multiple such as 1std)";
  const double value = core::parse_number(deviations ? text.substr(0, text.size() - 3) : text, allowed);
  if (!(value > 0)) throw InvalidArgument(std::string(what) + " must be above 0, not " + std::string(text));
  return {deviations ? Kind::deviations : Kind::fixed, value};
}

std::string to_string(const ValueRange& range) {
  switch (range.kind) {
    case ValueRange::Kind::local:
      return "local";
    case ValueRange::Kind::literal:
      return "literal";
    case ValueRange::Kind::fixed:
      return core::shortest(range.value);
    case ValueRange::Kind::deviations:
      break;
  }
  return core::shortest(range.value) + "std";
}

SalientResult salient(const core::ScalarField& input, const SalientOptions& options,
                      const core::Progress& progress) {
  check(options);
  const double sigma = sigma_on(input.mesh(), options);
  progress.update("salient smoothing", 0);
  Filter filter(input, options, sigma, progress);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    filter.iterate(iteration);
    if (!options.on_iteration) continue;
    const std::vector<double> values = filter.values();
    const std::vector<double> saliency = filter.saliency();
    options.on_iteration({iteration + 1, values, saliency});
  }
  progress.update("salient smoothing", 1);
  if (options.iterations == 0) return {input, sigma, filter.sigma_s(), 0};
  return {keep_order(input, options.return_saliency ? filter.saliency() : filter.values()), sigma,
          filter.sigma_s(), filter.pairs()};
}

std::unique_ptr<core::Method> make_salient(core::ParameterReader& reader) {
  SalientOptions options;
  options.iterations =
      static_cast<int>(reader.count("iterations", 10, 0, 1'000'000, "how often the filter runs"));
  options.sigma = reader.length("sigma", core::Length::epsilons(8), core::kPositive,
                                "standard deviation of the weight of distances");
  options.range = parse_value_range(reader.text("range", "1std",
                                                "standard deviation of the weight of values: a multiple of "
                                                "the field's (1std), local, literal (sigma), or a number"),
                                    reader.owner() + ":range");
  options.support =
      reader.number("support", 2, core::kPositive, "radius of the neighbourhood, in multiples of sigma");
  options.return_saliency = reader.choice("classify", "smoothed", {"smoothed", "saliency"},
                                          "the field to return: f, or the last S instead") == "saliency";
  check(options);
  return std::make_unique<Salient>(std::move(options));
}

}  // namespace morsel::morse
