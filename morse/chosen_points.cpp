#include "morsel/morse/chosen_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/operators/laplacian.h"
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

SaliencyOptions area_weighted() {
  SaliencyOptions options;
  options.weights = NeighborWeights::area;
  return options;
}

}  // namespace

std::string_view to_string(PointKind kind) {
  static constexpr std::array<std::string_view, kPointKinds.size()> kNames = {"extrema", "maxima", "minima",
                                                                              "saddles", "all"};
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

PointChooser::PointChooser(const core::TriangleMesh& mesh, std::size_t count, double spacing)
    : distances_(mesh), taken_(distances_, spacing), count_(count) {
  if (!(spacing >= 0) || !std::isfinite(spacing))
    throw core::InvalidArgument("the spacing of points must be finite and at least 0, not " +
                                core::shortest(spacing));
  chosen_.spacing = spacing;
}

void PointChooser::add(std::span<const PointCandidate> candidates, const core::Progress& progress) {
  const std::size_t source = chosen_.too_near.size();
  chosen_.too_near.push_back(0);
  for (const PointCandidate& candidate : candidates) {
    if (missing() == 0) break;
    progress.update("points", static_cast<double>(chosen_.points.size()) / static_cast<double>(count_));
    if (taken_.take(candidate.point.vertex))
      chosen_.points.push_back({candidate, source, 0});
    else
      ++chosen_.too_near.back();
  }
}

ChosenPoints PointChooser::finish() {
  std::vector<Index> vertices;
  vertices.reserve(chosen_.points.size());
  for (const ChosenPoint& point : chosen_.points) vertices.push_back(point.candidate.point.vertex);
  const std::vector<double> nearest = distances_.to_nearest_other(vertices);
  for (std::size_t i = 0; i < nearest.size(); ++i) chosen_.points[i].distance = nearest[i];
  return std::move(chosen_);
}

ChosenPoints choose_points(const core::TriangleMesh& mesh,
                           std::span<const std::vector<PointCandidate>> candidates, std::size_t count,
                           double spacing, const core::Progress& progress) {
  PointChooser chooser(mesh, count, spacing);
  for (const std::vector<PointCandidate>& list : candidates) chooser.add(list, progress);
  return chooser.finish();
}

MeshSalience::MeshSalience(const core::TriangleMesh& mesh, const core::Progress& progress)
    : map_(saliency(mean_curvature(mesh, progress), area_weighted(), progress).field) {}

std::vector<double> MeshSalience::at(core::Length scale, const core::Progress& progress) const {
  GaussianOptions options;
  options.sigma = scale;
  options.weights = NeighborWeights::area;
  const ScalarField map = gaussian(map_, options, progress);
  const std::vector<double> areas = vertex_areas(unit_sized(map.mesh()).mesh, VertexArea::mixed);
  double sum = 0;
  double total = 0;
  for (Index v = 0; v < areas.size(); ++v) {
    sum += areas[v] * map.value(v);
    total += areas[v];
  }
  std::vector<double> result(map.values().begin(), map.values().end());
  for (double& value : result) value = sum > 0 ? value / (sum / total) : 1;
  return result;
}

std::vector<double> mesh_salience(const core::TriangleMesh& mesh, core::Length scale,
                                  const core::Progress& progress) {
  return MeshSalience(mesh, progress).at(scale, progress);
}

}  // namespace morsel::morse
