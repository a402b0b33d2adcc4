#include "morsel/morse/operators/low_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

constexpr double kNegligible = 1e-9;  // as a coefficient

/// c_j with Σ c_j T_j(1 − k) = exp(−ln 2 (k/cutoff)²) for k from 0 to 2.
std::vector<double> chebyshev_coefficients(double cutoff) {
  // As a function of θ with cos θ = 1 − k the filter drops at θ_c, and its cosine series at a multiple of
  // 1/θ_c.
  const double fall = std::sqrt(2 * cutoff);
  const auto points = static_cast<std::size_t>(std::ceil(64 + 64 / fall));
  std::vector<std::pair<double, double>> samples;  // θ and the filter, where it is not yet 0
  for (std::size_t m = 0; m < points; ++m) {
    const double angle = (static_cast<double>(m) + 0.5) * M_PI / static_cast<double>(points);
    const double ratio = 2 * std::pow(std::sin(angle / 2), 2) / cutoff;  // k/cutoff
    const double kept = std::exp2(-ratio * ratio);
    if (kept < kNegligible * kNegligible) break;
    samples.emplace_back(angle, kept);
  }
  std::vector<double> coefficients(points);
  for (std::size_t j = 0; j < points; ++j) {
    double sum = 0;
    for (const auto& [angle, kept] : samples) sum += kept * std::cos(static_cast<double>(j) * angle);
    coefficients[j] = (j == 0 ? 1 : 2) * sum / static_cast<double>(points);
  }
  while (coefficients.size() > 1 && std::abs(coefficients.back()) < kNegligible) coefficients.pop_back();
  double total = 0;
  for (const double c : coefficients) total += c;
  for (double& c : coefficients) c /= total;  // constants are kept
  return coefficients;
}

/// P: each vertex the mean of its neighbours, at a boundary of those along it.
class Averages {
 public:
  explicit Averages(const TriangleMesh& mesh) : start_(mesh.vertex_count() + 1, 0) {
    std::vector<Index> ring;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      mesh.neighbors(static_cast<Index>(v), ring);
      if (mesh.is_boundary_vertex(static_cast<Index>(v)))
        neighbors_.insert(neighbors_.end(), {ring.front(), ring.back()});
      else
        neighbors_.insert(neighbors_.end(), ring.begin(), ring.end());
      start_[v + 1] = neighbors_.size();
    }
  }

  Point at(std::size_t v, std::span<const Point> values) const {
    Point sum = Point::Zero();
    for (std::size_t i = start_[v]; i < start_[v + 1]; ++i) sum += values[neighbors_[i]];
    return sum / static_cast<double>(start_[v + 1] - start_[v]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<Index> neighbors_;
};

void check(const TriangleMesh& mesh, const core::Length& scale) {
  if (!(scale.value >= 0) || !std::isfinite(scale.value))
    throw core::InvalidArgument("a scale must be finite and at least 0, not " + core::to_string(scale));
  const double length = scale.on(mesh);
  const double diagonal = mesh.bounding_box().diagonal();
  if (length > diagonal)
    throw core::BadInput("scale = " + core::to_string(scale) + " comes to " + core::shortest(length) +
                         " on this mesh, more than the diagonal of its bounding box, " +
                         core::shortest(diagonal) + ": nothing would be left of it");
}

}  // namespace

TriangleMesh low_pass(const TriangleMesh& mesh, core::Length scale, const core::Progress& progress) {
  check(mesh, scale);
  const UnitSized unit = unit_sized(mesh);
  const double edge = core::mean_edge_length(unit.mesh);
  const double length = std::ldexp(scale.on(mesh), -unit.exponent);
  if (!(length > 0) || !(edge > 0)) return mesh;
  const std::vector<double> coefficients =
      chebyshev_coefficients(std::pow(edge / (2 * std::max(length, 1e-3 * edge)), 2));
  const Averages averages(mesh);
  const std::size_t n = mesh.vertex_count();
  const core::BoundingBox& box = unit.mesh.bounding_box();
  const Point center = (box.min + box.max) / 2;
  // T_0 = x, T_1 = P x, T_{j+1} = 2 P T_j − T_{j−1}
  std::vector<Point> before(n);
  std::vector<Point> current(n);
  std::vector<Point> next(n);
  std::vector<Point> sum(n);
  core::parallel_for_each(n, [&](std::size_t v) {
    current[v] = unit.mesh.position(static_cast<Index>(v)) - center;
    sum[v] = coefficients[0] * current[v];
  });
  for (std::size_t j = 1; j < coefficients.size(); ++j) {
    progress.throw_if_cancelled();
    progress.update("surface", static_cast<double>(j) / static_cast<double>(coefficients.size()));
    core::parallel_for_each(n, [&](std::size_t v) {
      const Point mean = averages.at(v, current);
      next[v] = j == 1 ? mean : Point(2 * mean - before[v]);
      sum[v] += coefficients[j] * next[v];
    });
    std::swap(before, current);
    std::swap(current, next);
  }
  core::parallel_for_each(n, [&](std::size_t v) {
    for (int axis = 0; axis < 3; ++axis)
      sum[v][axis] = std::ldexp(sum[v][axis] + center[axis], unit.exponent);
  });
  progress.update("surface", 1);
  return mesh.with_positions(std::move(sum));
}

core::Length read_scale(core::ParameterReader& reader, core::Length default_scale) {
  return reader.length("scale", default_scale, core::kNonNegative,
                       "the surface is smoothed first, on a copy: waves of 2 pi scale keep half their height "
                       "(8eps, 1.5edges; 0: as it is)");
}

}  // namespace morsel::morse
