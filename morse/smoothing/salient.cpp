#include "morsel/morse/smoothing/salient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/morse/smoothing/keep_order.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::InvalidArgument;

/// The population's standard deviation, every value counting with its weight if there are any; exactly 0 for
/// a constant. Values are of order 1.
double standard_deviation(std::span<const double> values, std::span<const double> weights) {
  const double base = *std::min_element(values.begin(), values.end());
  const auto sum = [&](const auto& term) {
    return core::parallel_reduce(
        0, values.size(), core::kGrain, 0.0,
        [&](std::size_t first, std::size_t last) {
          double part = 0;
          if (weights.empty())
            for (std::size_t v = first; v < last; ++v) part += term(values[v] - base);
          else
            for (std::size_t v = first; v < last; ++v) part += weights[v] * term(values[v] - base);
          return part;
        },
        [](double a, double b) { return a + b; });
  };
  const double n = weights.empty() ? static_cast<double>(values.size()) : sum([](double) { return 1.0; });
  if (!(n > 0)) return 0;
  const double mean = sum([](double g) { return g; }) / n;
  return std::sqrt(sum([&](double g) { return (g - mean) * (g - mean); }) / n);
}

/// Relative errors of the expansions, over the accuracy: they mostly cancel in a sum, and what is left may
/// grow from iteration to iteration.
constexpr double kToleranceOverAccuracy = 5;
/// The smallest accuracy that single precision keeps.
constexpr double kLeastAccuracy = 1e-5;
/// The gain is estimated too high by up to this (the cells' part waits for memory).
constexpr double kLeastGain = 1.75;

/// Whether the fast algorithms apply, which support neither areas nor connected balls.
bool is_plain(const SalientOptions& options) {
  return options.weights == NeighborWeights::none && options.ball == Ball::euclidean;
}

/// Whether the accuracy allows single precision.
bool is_rounded(const SalientOptions& options) {
  return options.accuracy >= kLeastAccuracy && is_plain(options);
}

BilateralFilter::Options filter_options(const core::TriangleMesh& mesh, const SalientOptions& options,
                                        double sigma, SalientAlgorithm algorithm) {
  const bool repeated = options.iterations > 1 || options.range.kind == ValueRange::Kind::local;
  const bool shared = algorithm == SalientAlgorithm::near_linear;
  BilateralFilter::Options result = {options.support * sigma,
                                     sigma,
                                     is_rounded(options) ? Precision::float32 : options.precision,
                                     options.instructions.value_or(best_instruction_set()),
                                     shared ? kToleranceOverAccuracy * options.accuracy : 0,
                                     repeated ? options.memory : 0};
  if (options.weights == NeighborWeights::area)
    result.weights = vertex_areas(unit_sized(mesh).mesh, VertexArea::mixed);
  if (options.ball == Ball::connected) result.connected_by = mesh;
  return result;
}

class Filter {
 public:
  Filter(const core::ScalarField& input, const SalientOptions& options, double sigma,
         SalientAlgorithm algorithm, const core::Progress& progress)
      : options_(options),
        progress_(progress),
        filter_options_(filter_options(input.mesh(), options, sigma, algorithm)),
        filter_(input.mesh().positions(), filter_options_, progress) {
    const std::size_t n = input.values().size();
    const double largest = std::max(std::abs(input.min()), std::abs(input.max()));
    // A power of two changes no digit, and keeps differences and squares in range.
    exponent_ = largest > 0 ? std::ilogb(largest) : 0;
    values_.resize(n);
    saliency_.assign(n, 0.0);
    core::parallel_for_each(n,
                            [&](std::size_t v) { values_[v] = std::ldexp(input.values()[v], -exponent_); });
    const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
    if (*most > *least) extent_ = *most - *least;
    const ValueRange& range = options.range;
    if (range.kind == ValueRange::Kind::none) scaled_sigma_s_ = std::numeric_limits<double>::infinity();
    if (range.kind == ValueRange::Kind::local || range.kind == ValueRange::Kind::none) return;
    if (range.kind == ValueRange::Kind::deviations) {
      scaled_sigma_s_ = range.value * standard_deviation(values_, filter_options_.weights);
      sigma_s_ = std::ldexp(*scaled_sigma_s_, exponent_);
    } else {
      sigma_s_ = range.kind == ValueRange::Kind::literal ? sigma : range.value;
      scaled_sigma_s_ = std::ldexp(*sigma_s_, -exponent_);
    }
  }

  std::optional<double> sigma_s() const { return sigma_s_; }
  std::vector<double> values() const { return unscaled(values_); }
  std::vector<double> saliency() const { return unscaled(saliency_); }
  std::uint64_t pairs() const { return filter_.pairs(); }
  bool rounded() const { return is_rounded(options_); }
  /// BilateralFilter::error() as a share of the input's extent.
  double error() const { return filter_.error() / extent_; }

  /// Why the near-linear algorithm does not run for this input; empty if it does.
  std::string why_exact() const {
    const std::optional<double> gain = filter_.gain(values_, scaled_sigma_s_.value_or(0));
    if (!gain)
      return "cells as small as the accuracy asks for hold too few vertices, or values spread too far";
    return *gain < kLeastGain && !options_.always_near_linear ? "it is the faster one" : "";
  }

  /// All iterations; false if the error was found to be above the accuracy.
  bool run() {
    for (int iteration = 0; iteration < options_.iterations; ++iteration) {
      iterate(iteration);
      if (options_.accuracy > 0 && !(error() <= options_.accuracy)) return false;
      if (!options_.on_iteration) continue;
      const std::vector<double> values = this->values();
      const std::vector<double> saliency = this->saliency();
      if (!options_.on_iteration({iteration + 1, values, saliency})) break;
    }
    return true;
  }

 private:
  void iterate(int iteration) {
    filter_.apply(values_, scaled_sigma_s_, saliency_, [&](double done) {
      progress_.update(options_.step, (iteration + done) / options_.iterations);
    });
    core::parallel_for_each(values_.size(), [&](std::size_t v) { values_[v] += saliency_[v]; });
  }

  std::vector<double> unscaled(std::vector<double> values) const {
    core::parallel_for_each(values.size(),
                            [&](std::size_t v) { values[v] = std::ldexp(values[v], exponent_); });
    return values;
  }

  const SalientOptions& options_;
  const core::Progress& progress_;
  BilateralFilter::Options filter_options_;
  BilateralFilter filter_;
  std::optional<double> sigma_s_;  // none if local or beyond all differences
  int exponent_ = 0;               // what follows is the field's, divided by 2^exponent_
  double extent_ = 1;
  std::optional<double> scaled_sigma_s_;
  std::vector<double> values_;
  std::vector<double> saliency_;
};

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

/// Why the options alone rule out the near-linear algorithm; empty if they do not.
std::string why_exact(const SalientOptions& options) {
  if (!is_plain(options)) return "weights=area and ball=connected need every pair";
  if (options.range.kind == ValueRange::Kind::local) return "a local range needs every pair";
  if (options.range.kind == ValueRange::Kind::none) return "without a range every pair counts";
  if (options.accuracy < kLeastAccuracy)
    return "an accuracy below " + core::shortest(kLeastAccuracy) + " needs every pair";
  return "";
}

double sigma_on(const core::TriangleMesh& mesh, const SalientOptions& options) {
  const double sigma = options.sigma.on(mesh);
  // Below the normal numbers 1/σ has no value.
  if (!(sigma >= std::numeric_limits<double>::min()) || !std::isfinite(options.support * sigma)) {
    const std::string message = "sigma = " + core::to_string(options.sigma) + " comes to " +
                                core::shortest(sigma) +
                                " on this mesh, whose bounding box has the diagonal " +
                                core::shortest(mesh.bounding_box().diagonal());
    if (options.sigma.unit != core::LengthUnit::mesh) throw core::BadInput(message);
    throw InvalidArgument(message);
  }
  return sigma;
}

}  // namespace

std::string_view to_string(NeighborWeights weights) {
  return weights == NeighborWeights::area ? "area" : "none";
}

std::string_view to_string(Ball ball) { return ball == Ball::connected ? "connected" : "euclidean"; }

void check(const SalientOptions& options) {
  if (options.iterations < 0)
    throw InvalidArgument("salient smoothing cannot run " + std::to_string(options.iterations) +
                          " iterations");
  if (options.iterations == 0 && options.return_saliency)
    throw InvalidArgument("there is no saliency without an iteration: iterations must be at least 1");
  if (!is_positive(options.sigma.value))
    throw InvalidArgument("sigma must be finite and above 0, not " + core::to_string(options.sigma));
  if (!(options.accuracy >= 0 && options.accuracy <= 1))
    throw InvalidArgument("accuracy must be between 0 and 1, not " + core::shortest(options.accuracy));
  if (!is_positive(options.support))
    throw InvalidArgument("support must be finite and above 0, not " + core::shortest(options.support));
  const bool has_value =
      options.range.kind == ValueRange::Kind::deviations || options.range.kind == ValueRange::Kind::fixed;
  if (has_value && !is_positive(options.range.value))
    throw InvalidArgument("range must be finite and above 0, not " + to_string(options.range));
  if (options.precision == Precision::float32 && !is_plain(options))
    throw InvalidArgument(
        "precision=single is not available with weights=" + std::string(to_string(options.weights)) +
        ",ball=" + std::string(to_string(options.ball)) + ", which are computed in double precision");
  const std::vector<InstructionSet> sets = instruction_sets();
  if (options.instructions && std::find(sets.begin(), sets.end(), *options.instructions) == sets.end())
    throw InvalidArgument("this processor, or this build, does not have the instruction set " +
                          std::string(to_string(*options.instructions)));
}

SalientResult salient(const core::ScalarField& input, const SalientOptions& options,
                      const core::Progress& progress) {
  check(options);
  const double sigma = sigma_on(input.mesh(), options);
  progress.update(options.step, 0);
  std::string reason;
  double estimate = 0;
  const auto result = [&](const Filter& filter, SalientAlgorithm algorithm) {
    progress.update(options.step, 1);
    const bool promised = filter.rounded() || algorithm == SalientAlgorithm::near_linear;
    return SalientResult{keep_order(input, options.return_saliency ? filter.saliency() : filter.values()),
                         sigma,
                         filter.sigma_s(),
                         filter.pairs(),
                         algorithm,
                         promised ? options.accuracy : 0,
                         estimate,
                         reason};
  };
  if (options.accuracy > 0 && options.iterations > 0) {
    reason = why_exact(options);
    if (reason.empty()) {
      Filter filter(input, options, sigma, SalientAlgorithm::near_linear, progress);
      reason = filter.why_exact();
      if (reason.empty()) {
        const bool kept = filter.run();
        estimate = filter.error();
        if (kept) return result(filter, SalientAlgorithm::near_linear);
        reason = "the near-linear algorithm may have erred by more than the accuracy";
      }
    }
  }
  Filter filter(input, options, sigma, SalientAlgorithm::exact, progress);
  filter.run();
  if (options.iterations == 0) return {input, sigma, filter.sigma_s()};
  return result(filter, SalientAlgorithm::exact);
}

}  // namespace morsel::morse
