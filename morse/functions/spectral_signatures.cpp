#include "morsel/morse/functions/spectral_signatures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/eigenfunction.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/eigenfunctions.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::TriangleMesh;

std::vector<Eigenfunction> lowest(const TriangleMesh& mesh, std::size_t modes,
                                  const core::Progress& progress) {
  if (modes == 0) throw core::InvalidArgument("a signature needs at least one mode");
  return eigenfunctions(mesh, std::min<std::size_t>(modes, nonconstant_eigenfunction_count(mesh)), progress);
}

/// Adds Σ_k w_k φ_k² to the values.
void add_squares(std::span<const Eigenfunction> functions, std::span<const double> weights,
                 std::vector<double>& values) {
  core::parallel_for_each(values.size(), [&](std::size_t v) {
    for (std::size_t k = 0; k < functions.size(); ++k)
      values[v] += weights[k] * functions[k].phi[v] * functions[k].phi[v];
  });
}

/// The square of each component's constant eigenfunction, 1/area.
std::vector<double> squared_constants(const TriangleMesh& mesh) {
  const EdgeLengths lengths = edge_lengths(mesh);
  const std::vector<double> areas = barycentric_areas(mesh, lengths);
  std::vector<double> total(mesh.component_count(), 0.0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) total[mesh.component_of_vertex(v)] += areas[v];
  std::vector<double> values(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    values[v] = 1 / total[mesh.component_of_vertex(v)] / lengths.unit / lengths.unit;
  return values;
}

std::size_t read_modes(core::ParameterReader& reader) {
  return static_cast<std::size_t>(
      reader.count("modes", 100, 1, kMostModes, "how many of the lowest eigenfunctions are summed"));
}

class HeatKernelSignature final : public core::MorseFunction {
 public:
  HeatKernelSignature(core::Length spread, std::size_t modes) : spread_(spread), modes_(modes) {}

  core::FunctionResult evaluate(const TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    const double spread = spread_.on(mesh);
    if (!(spread > 0))
      throw core::BadInput("time = " + core::to_string(spread_) + " comes to " + core::shortest(spread) +
                           " on this mesh, whose vertices all coincide");
    Signature signature = heat_kernel_signature(mesh, spread, modes_, context.progress);
    return {std::move(signature.field),
            {{"time", spread},
             {"modes", static_cast<std::int64_t>(signature.modes)},
             {"last_weight", signature.last}}};
  }

 private:
  core::Length spread_;
  std::size_t modes_;
};

class WaveKernelSignature final : public core::MorseFunction {
 public:
  WaveKernelSignature(double energy, double width, std::size_t modes)
      : energy_(energy), width_(width), modes_(modes) {}

  core::FunctionResult evaluate(const TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    Signature signature = wave_kernel_signature(mesh, energy_, width_, modes_, context.progress);
    return {std::move(signature.field),
            {{"energy", energy_},
             {"width", width_},
             {"modes", static_cast<std::int64_t>(signature.modes)},
             {"last_weight", signature.last}}};
  }

 private:
  double energy_;
  double width_;
  std::size_t modes_;
};

}  // namespace

Signature heat_kernel_signature(const TriangleMesh& mesh, double spread, std::size_t modes,
                                const core::Progress& progress) {
  if (!(spread > 0) || !std::isfinite(spread))
    throw core::InvalidArgument("the length that heat spreads must be finite and above 0, not " +
                                core::shortest(spread));
  const std::vector<Eigenfunction> functions = lowest(mesh, modes, progress);
  std::vector<double> weights(functions.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    weights[k] = std::exp(-(functions[k].eigenvalue * spread) * spread / 2);
  std::vector<double> values = squared_constants(mesh);
  add_squares(functions, weights, values);
  return {{mesh, std::move(values)}, functions.size(), weights.empty() ? 0 : weights.back()};
}

Signature wave_kernel_signature(const TriangleMesh& mesh, double energy, double width, std::size_t modes,
                                const core::Progress& progress) {
  if (!(energy >= 0 && energy <= 1))
    throw core::InvalidArgument("an energy must be from 0 (the lowest mode) to 1 (the highest), not " +
                                core::shortest(energy));
  if (!(width >= kLeastWidth) || !std::isfinite(width))
    throw core::InvalidArgument("the width of an energy must be finite and at least " +
                                core::shortest(kLeastWidth) + ", not " + core::shortest(width));
  const std::vector<Eigenfunction> functions = lowest(mesh, modes, progress);
  std::vector<double> weights(functions.size());
  const double low = std::log(functions.front().eigenvalue);
  const double range = std::log(functions.back().eigenvalue) - low;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double place = range > 0 ? (std::log(functions[k].eigenvalue) - low) / range : energy;
    weights[k] = -std::pow((energy - place) / width, 2) / 2;
  }
  const double largest = *std::max_element(weights.begin(), weights.end());
  double total = 0;
  for (double& weight : weights) total += weight = std::exp(weight - largest);
  const double last = weights.back();
  for (double& weight : weights) weight /= total;
  std::vector<double> values(mesh.vertex_count(), 0.0);
  add_squares(functions, weights, values);
  return {{mesh, std::move(values)}, functions.size(), last};
}

std::unique_ptr<core::MorseFunction> make_heat_kernel_signature(core::ParameterReader& reader) {
  const core::Length spread = reader.length("time", core::Length::root_areas(0.1), core::kPositive,
                                            "of the heat, as the length by which it spreads in it");
  return std::make_unique<HeatKernelSignature>(spread, read_modes(reader));
}

std::unique_ptr<core::MorseFunction> make_wave_kernel_signature(core::ParameterReader& reader) {
  const double energy =
      reader.number("energy", 0.5, {0, false, 1},
                    "logarithm of the eigenvalue, from 0 (the lowest mode) to 1 (the highest)");
  const double width = reader.number("width", 0.07, {kLeastWidth}, "standard deviation of the energy");
  return std::make_unique<WaveKernelSignature>(energy, width, read_modes(reader));
}

}  // namespace morsel::morse
