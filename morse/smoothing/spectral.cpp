#include "morsel/morse/smoothing/spectral.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "morsel/morse/functions/eigenfunction.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/eigenfunctions.h"
#include "morsel/morse/smoothing/keep_order.h"

namespace morsel::morse {
namespace {

using core::Index;

class Spectral final : public core::Method {
 public:
  explicit Spectral(std::int64_t modes) : modes_(modes) {}

  core::MethodResult apply(const core::ScalarField& input,
                           const core::MethodContext& context) const override {
    SpectralResult result = spectral(input, static_cast<std::size_t>(modes_), context.progress);
    return {std::move(result.field),
            {{"modes", modes_}},
            {{"last_eigenvalue", result.last_eigenvalue}, {"variance_kept", result.kept}}};
  }

 private:
  std::int64_t modes_;
};

/// The values less the means of their components, which are returned.
std::vector<double> subtract_means(const core::TriangleMesh& mesh, const std::vector<double>& areas,
                                   std::vector<double>& values) {
  std::vector<double> mean(mesh.component_count(), 0.0);
  std::vector<double> area(mesh.component_count(), 0.0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    mean[mesh.component_of_vertex(v)] += areas[v] * values[v];
    area[mesh.component_of_vertex(v)] += areas[v];
  }
  for (std::size_t c = 0; c < mean.size(); ++c) mean[c] /= area[c];
  for (Index v = 0; v < mesh.vertex_count(); ++v) values[v] -= mean[mesh.component_of_vertex(v)];
  return mean;
}

}  // namespace

SpectralResult spectral(const core::ScalarField& field, std::size_t modes, const core::Progress& progress) {
  const core::TriangleMesh& mesh = field.mesh();
  const std::vector<Eigenfunction> functions = eigenfunctions(mesh, modes, progress);
  const double last = functions.empty() ? 0 : functions.back().eigenvalue;
  const EdgeLengths lengths = edge_lengths(mesh);
  std::vector<double> areas = barycentric_areas(mesh, lengths);
  for (double& area : areas) area *= lengths.unit * lengths.unit;
  const std::size_t n = areas.size();

  // Values count as shares of the largest, so that no sum overflows.
  const double unit = std::max(std::abs(field.min()), std::abs(field.max()));
  if (unit == 0) return {field, last, 1};
  std::vector<double> rest(n);
  for (std::size_t v = 0; v < n; ++v) rest[v] = field.values()[v] / unit;
  const std::vector<double> means = subtract_means(mesh, areas, rest);
  const auto variance = [&](const std::vector<double>& values) {
    double sum = 0;
    for (std::size_t v = 0; v < n; ++v) sum += areas[v] * values[v] * values[v];
    return sum;
  };
  std::vector<double> kept(n, 0.0);
  for (const Eigenfunction& function : functions) {
    double coefficient = 0;
    for (std::size_t v = 0; v < n; ++v) coefficient += areas[v] * function.phi[v] * rest[v];
    for (std::size_t v = 0; v < n; ++v) kept[v] += coefficient * function.phi[v];
  }
  const double all = variance(rest);
  const double share = all > 0 ? std::min(variance(kept) / all, 1.0) : 1;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    kept[v] = (kept[v] + means[mesh.component_of_vertex(v)]) * unit;
  return {keep_order(field, std::move(kept)), last, share};
}

std::unique_ptr<core::Method> make_spectral(core::ParameterReader& reader) {
  return std::make_unique<Spectral>(reader.count(
      "modes", 20, 1, kMostModes, "how many eigenfunctions, from the lowest, without constants"));
}

}  // namespace morsel::morse
