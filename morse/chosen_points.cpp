#include "morsel/morse/chosen_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/surface_distance.h"
#include "morsel/morse/operators/unit_size.h"
#include "morsel/morse/smoothing/gaussian.h"
#include "morsel/morse/smoothing/saliency.h"
#include "morsel/persistence/pairing.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::ScalarField;

bool is_of(PointKind kind, CriticalType type) {
  switch (kind) {
    case PointKind::extrema:
      return type != CriticalType::saddle;
    case PointKind::maxima:
      return type == CriticalType::maximum;
    case PointKind::minima:
      return type == CriticalType::minimum;
    case PointKind::saddles:
      return type == CriticalType::saddle;
    default:
      return true;
  }
}

/// max − min on each component.
std::vector<double> component_extents(const ScalarField& field) {
  const core::TriangleMesh& mesh = field.mesh();
  std::vector<double> low(mesh.component_count(), HUGE_VAL);
  std::vector<double> high(mesh.component_count(), -HUGE_VAL);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index c = mesh.component_of_vertex(v);
    low[c] = std::min(low[c], field.value(v));
    high[c] = std::max(high[c], field.value(v));
  }
  for (std::size_t c = 0; c < low.size(); ++c)
    high[c] = std::min(high[c] - low[c], std::numeric_limits<double>::max());
  return high;
}

/// Of points of equal rank, the one with the least key comes first.
std::pair<int, std::int64_t> key_of(const ScalarField& field, const CriticalPoint& point) {
  const auto height = static_cast<std::int64_t>(field.rank(point.vertex));
  if (point.type == CriticalType::minimum) return {1, height};
  return {point.type == CriticalType::maximum ? 0 : 2, -height};
}

}  // namespace

std::string_view to_string(PointKind kind) {
  static constexpr std::array<std::string_view, 5> kNames = {"extrema", "maxima", "minima", "saddles", "all"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view to_string(PointRank rank) {
  return rank == PointRank::persistence ? "persistence" : "salience";
}

std::vector<PointCandidate> point_candidates(const ScalarField& field, PointKind kind,
                                             std::span<const double> weight, const core::Progress& progress) {
  const Index n = field.mesh().vertex_count();
  if (!weight.empty() && weight.size() != n)
    throw core::InvalidArgument("there must be a weight for each vertex, or none");
  const std::vector<double> persistence =
      persistence::vertex_persistence(persistence::pair_extrema(field, progress), n);
  const std::vector<double> extent = component_extents(field);
  std::vector<PointCandidate> candidates;
  for (const CriticalPoint& point : classify(field, progress).points) {
    if (!is_of(kind, point.type)) continue;
    const double own = persistence[point.vertex];
    const double finite = std::isinf(own) ? extent[field.mesh().component_of_vertex(point.vertex)] : own;
    const double rank = finite * (weight.empty() ? 1 : weight[point.vertex]);
    if (rank > 0) candidates.push_back({point, field.value(point.vertex), own, rank});
  }
  std::sort(candidates.begin(), candidates.end(), [&](const PointCandidate& a, const PointCandidate& b) {
    if (a.rank != b.rank) return a.rank > b.rank;
    return key_of(field, a.point) < key_of(field, b.point);
  });
  return candidates;
}

ChosenPoints choose_points(const core::TriangleMesh& mesh,
                           std::span<const std::vector<PointCandidate>> candidates, std::size_t count,
                           double spacing, const core::Progress& progress) {
  if (!(spacing >= 0) || !std::isfinite(spacing))
    throw core::InvalidArgument("the spacing of points must be finite and at least 0, not " +
                                core::shortest(spacing));
  progress.update("points", 0);
  ChosenPoints chosen;
  chosen.spacing = spacing;
  const SurfaceDistances distances(mesh);
  SurfaceDistances::Search search(distances);
  std::vector<bool> is_near(mesh.vertex_count());
  std::vector<Index> vertices;
  for (std::size_t source = 0; source < candidates.size(); ++source) {
    chosen.too_near.push_back(0);
    for (const PointCandidate& candidate : candidates[source]) {
      if (chosen.points.size() == count) break;
      progress.throw_if_cancelled();
      const Index v = candidate.point.vertex;
      if (is_near[v]) {
        ++chosen.too_near.back();
        continue;
      }
      chosen.points.push_back({candidate, source, 0});
      vertices.push_back(v);
      is_near[v] = true;
      for (const auto& [u, distance] : search.within(v, spacing)) is_near[u] = true;
    }
  }
  const std::vector<double> nearest = distances.to_nearest_other(vertices);
  for (std::size_t i = 0; i < nearest.size(); ++i) chosen.points[i].distance = nearest[i];
  progress.update("points", 1);
  return chosen;
}

std::vector<double> mesh_salience(const core::TriangleMesh& mesh, core::Length scale,
                                  const core::Progress& progress) {
  SaliencyOptions options;
  options.weights = NeighborWeights::area;
  GaussianOptions average;
  average.sigma = scale;
  average.weights = NeighborWeights::area;
  const ScalarField map =
      gaussian(saliency(mean_curvature(mesh, progress), options, progress).field, average, progress);
  const std::vector<double> areas = vertex_areas(unit_sized(mesh).mesh, VertexArea::mixed);
  double sum = 0;
  double total = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    sum += areas[v] * map.value(v);
    total += areas[v];
  }
  std::vector<double> result(map.values().begin(), map.values().end());
  for (double& value : result) value = sum > 0 ? value / (sum / total) : 1;
  return result;
}

}  // namespace morsel::morse
