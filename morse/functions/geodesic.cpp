#include "morsel/morse/functions/geodesic.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/edge_paths.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::TriangleMesh;

/// Samples that are solved at a time; each needs a value a vertex.
constexpr std::size_t kBatch = 16;

HeatOptions heat_options(const GeodesicOptions& options, double reach) {
  return {options.time, reach, options.boundary, options.delaunay};
}

}  // namespace

GeodesicResult geodesic_distance(const TriangleMesh& mesh, std::span<const Index> sources,
                                 const GeodesicOptions& options, const core::Progress& progress) {
  if (sources.empty()) throw core::InvalidArgument("a geodesic distance needs at least one source");
  for (const Index s : sources)
    if (s >= mesh.vertex_count())
      throw core::InvalidArgument("there is no vertex " + std::to_string(s) + " among the " +
                                  std::to_string(mesh.vertex_count()) + " of the mesh");
  double reach = 0;
  for (const double d : edge_distances(mesh, sources))
    if (d < HUGE_VAL) reach = std::max(reach, d);  // what is not reached is refused below
  const HeatDistance distance(mesh, heat_options(options, reach), progress);
  return {core::ScalarField(mesh, distance.from(sources)), distance.time()};
}

AverageGeodesicResult average_geodesic_distance(const TriangleMesh& mesh, std::size_t samples,
                                                const GeodesicOptions& options,
                                                const core::Progress& progress) {
  if (samples == 0) throw core::InvalidArgument("an average of distances needs at least one sample");
  if (mesh.component_count() > 1)
    throw core::BadInput("the average geodesic distance needs a connected surface, and this one has " +
                         std::to_string(mesh.component_count()) +
                         " components, between which there is no distance");
  progress.update("base points", 0);
  FarthestPoints spread = farthest_points(mesh, samples);
  const std::vector<double> areas = vertex_areas(mesh, VertexArea::barycentric);
  std::vector<double> weight(spread.points.size(), 0.0);
  double total = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    weight[spread.nearest[v]] += areas[v];
    total += areas[v];
  }
  // The first point is at an end: no two vertices are farther apart than twice its reach.
  const HeatDistance distance(mesh, heat_options(options, 2 * spread.reach), progress);
  std::vector<double> sum(mesh.vertex_count(), 0.0);
  for (std::size_t first = 0; first < spread.points.size(); first += kBatch) {
    progress.update("distances", static_cast<double>(first) / static_cast<double>(spread.points.size()));
    const std::size_t last = std::min(first + kBatch, spread.points.size());
    std::vector<std::vector<double>> part(last - first);
    core::parallel_for(first, last, 1, [&](std::size_t i, std::size_t) {
      part[i - first] = distance.from(std::span(spread.points).subspan(i, 1));
    });
    core::parallel_for_each(sum.size(), [&](std::size_t v) {
      for (std::size_t i = first; i < last; ++i) sum[v] += part[i - first][v] * (weight[i] / total);
    });
  }
  return {core::ScalarField(mesh, std::move(sum)), distance.time(), std::move(spread.points)};
}

}  // namespace morsel::morse
