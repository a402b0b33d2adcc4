#include "morsel/morse/operators/edge_paths.h"

#include <algorithm>
#include <cmath>

#include "morsel/core/field/link.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/shortest_paths.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

/// Lowers the distances along edges to those from v, calling visit(u) whenever it lowers one.
template <class Visit>
void spread_from(const TriangleMesh& mesh, Index v, ShortestPaths& paths, const Visit& visit) {
  const auto lower = [&](Index u, double d) {
    if (paths.lower(u, d)) visit(u);
  };
  lower(v, 0);
  paths.run([&](Index from, double d) {
    core::for_each_neighbor(mesh, from,
                            [&](Index u) { lower(u, d + (mesh.position(u) - mesh.position(from)).norm()); });
  });
}

Index farthest_from_centre(const TriangleMesh& mesh) {
  const std::vector<double> areas = vertex_areas(mesh, VertexArea::barycentric);
  Point centre = Point::Zero();
  double area = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    centre += areas[v] * mesh.position(v);
    area += areas[v];
  }
  centre = area > 0 ? Point(centre / area) : mesh.position(0);
  Index best = 0;
  for (Index v = 1; v < mesh.vertex_count(); ++v)
    if ((mesh.position(v) - centre).norm() > (mesh.position(best) - centre).norm()) best = v;
  return best;
}

}  // namespace

std::vector<double> edge_distances(const TriangleMesh& mesh, std::span<const Index> sources) {
  ShortestPaths paths(mesh.vertex_count());
  for (const Index s : sources) spread_from(mesh, s, paths, [](Index) {});
  return paths.distances();
}

FarthestPoints farthest_points(const TriangleMesh& mesh, std::size_t count) {
  FarthestPoints result;
  result.nearest.assign(mesh.vertex_count(), 0);
  ShortestPaths paths(mesh.vertex_count());
  const std::vector<double>& distance = paths.distances();
  for (Index next = farthest_from_centre(mesh);;) {
    const auto number = static_cast<Index>(result.points.size());
    result.points.push_back(next);
    spread_from(mesh, next, paths, [&](Index v) { result.nearest[v] = number; });
    next = static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (number == 0) result.reach = distance[next];
    if (result.points.size() == count || distance[next] == 0) return result;
  }
}

}  // namespace morsel::morse
