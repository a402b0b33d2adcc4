#include "morsel/morse/smoothing/diffusion.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/smoothing/iteration.h"

namespace morsel::morse {
namespace {

using core::InvalidArgument;

/// Calls visit(i, Σ_j w_ij (f_j − f_i), Σ_j |w_ij|) for each row. By differences, so that a constant gives
/// exactly 0.
template <class Visit>
void for_each_difference(const SparseMatrix& laplacian, std::span<const double> f, const Visit& visit) {
  const int* const start = laplacian.outerIndexPtr();
  const int* const column = laplacian.innerIndexPtr();
  const double* const entry = laplacian.valuePtr();
  core::parallel_for_each(f.size(), [&](std::size_t i) {
    double sum = 0;
    double magnitude = 0;
    for (int k = start[i]; k < start[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(column[k]);
      if (j == i) continue;
      sum -= entry[k] * (f[j] - f[i]);
      magnitude += std::abs(entry[k]);
    }
    visit(i, sum, magnitude);
  });
}

SparseMatrix step_matrix(const core::TriangleMesh& mesh, const SparseMatrix& laplacian, double time) {
  if (!(time > 0 && std::isfinite(time)))
    throw InvalidArgument("the time of an implicit step must be finite and above 0, not " +
                          core::shortest(time));
  return heat_matrix(laplacian, vertex_areas(mesh, VertexArea::barycentric), time);
}

struct DiffusionOptions {
  bool implicit = false;
  EdgeWeights weights = EdgeWeights::uniform;
  double lambda = 0.5;
  core::Length spread = core::Length::root_areas(0.006);
};

class LaplacianSmoothing final : public core::Method {
 public:
  LaplacianSmoothing(const DiffusionOptions& options, const StopCriteria& criteria)
      : options_(options), criteria_(criteria) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    const core::TriangleMesh& mesh = input.mesh();
    core::Parameters parameters = {{"scheme", options_.implicit ? "implicit" : "explicit"},
                                   {"weights", std::string(to_string(options_.weights))}};
    std::function<std::vector<double>(std::span<const double>)> step;
    if (options_.implicit) {
      const double spread = options_.spread.on(mesh);
      const double time = spread * spread / 2;
      parameters.emplace_back("spread", spread);
      parameters.emplace_back("time", time);
      step = [diffusion = ImplicitDiffusion(mesh, options_.weights, time, context.progress)](auto values) {
        return diffusion.step(values);
      };
    } else {
      parameters.emplace_back("lambda", options_.lambda);
      step = [diffusion = ExplicitDiffusion(mesh, options_.weights, options_.lambda)](auto values) {
        return diffusion.step(values);
      };
    }
    IterationControl control(input, criteria_, context);
    std::vector<double> values(input.values().begin(), input.values().end());
    while (control.more()) {
      context.progress.update("Laplacian smoothing",
                              static_cast<double>(control.iterations_run()) / criteria_.iterations);
      values = step(values);
      if (control.needs_field())
        control.record(values);
      else
        control.skip();
    }
    return control.result(std::move(parameters));
  }

  core::MethodTraits traits() const override { return {.iterates = true, .iterates_are_results = true}; }

 private:
  DiffusionOptions options_;
  StopCriteria criteria_;
};

}  // namespace

ExplicitDiffusion::ExplicitDiffusion(const core::TriangleMesh& mesh, EdgeWeights weights, double lambda)
    : laplacian_(laplacian(mesh, edge_weights(mesh, weights))), lambda_(lambda) {
  if (!(lambda > 0 && lambda <= 1))
    throw InvalidArgument("lambda must be above 0 and at most 1, not " + core::shortest(lambda));
}

std::vector<double> ExplicitDiffusion::step(std::span<const double> values) const {
  std::vector<double> result(values.begin(), values.end());
  for_each_difference(laplacian_, values, [&](std::size_t i, double sum, double magnitude) {
    if (magnitude > 0) result[i] += lambda_ * (sum / magnitude);
  });
  return result;
}

ImplicitDiffusion::ImplicitDiffusion(const core::TriangleMesh& mesh, EdgeWeights weights, double time,
                                     const core::Progress& progress)
    : laplacian_(laplacian(mesh, edge_weights(mesh, weights))),
      time_(time),
      system_(step_matrix(mesh, laplacian_, time), "implicit smoothing", progress) {}

std::vector<double> ImplicitDiffusion::step(std::span<const double> values) const {
  // Solved for the change, (M + t L)(f' − f) = −t L f.
  std::vector<double> right(values.size());
  for_each_difference(laplacian_, values, [&](std::size_t i, double sum, double) { right[i] = time_ * sum; });
  std::vector<double> result = system_.solve(right);
  core::parallel_for_each(result.size(), [&](std::size_t i) { result[i] += values[i]; });
  return result;
}

std::unique_ptr<core::Method> make_laplacian(core::ParameterReader& reader) {
  const StopCriteria criteria = read_stop_criteria(reader, 10);
  DiffusionOptions options;
  options.implicit =
      reader.choice("scheme", "explicit", {"explicit", "implicit"},
                    "steps towards the neighbours' mean, or the heat equation solved") == "implicit";
  options.weights = read_edge_weights(reader, EdgeWeights::uniform);
  options.lambda =
      reader.number("lambda", options.lambda, {0, true, 1}, "share of an explicit step, up to 1");
  options.spread = reader.length("time", options.spread, core::kPositive,
                                 "time of an implicit step, as the length by which heat spreads in it");
  const char* const other = options.implicit ? "lambda" : "time";
  if (reader.given(other))
    throw InvalidArgument(reader.owner() + ":" + other +
                          " has no meaning with scheme=" + (options.implicit ? "implicit" : "explicit"));
  return std::make_unique<LaplacianSmoothing>(options, criteria);
}

}  // namespace morsel::morse
