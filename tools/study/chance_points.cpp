#include "morsel/tools/study/chance_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::tools {

using core::Index;

std::vector<Index> random_points(const core::TriangleMesh& mesh, const morse::SurfaceDistances& distances,
                                 std::size_t count, double spacing, RandomStream random) {
  const std::vector<double> areas =
      morse::vertex_areas(morse::unit_sized(mesh).mesh, morse::VertexArea::barycentric);
  // Waiting times at rates that are the areas. The logarithm, whose last bit differs between machines,
  // decides the order and enters no value; vertices without an area come last.
  std::vector<double> waiting(areas.size());
  for (std::size_t v = 0; v < areas.size(); ++v) waiting[v] = -std::log(random.uniform()) / areas[v];
  std::vector<Index> order(areas.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index v) { return waiting[v]; });
  morse::SpacedVertices apart(distances, spacing);
  std::vector<Index> points;
  for (auto v = order.begin(); v != order.end() && points.size() < count; ++v)
    if (apart.take(*v)) points.push_back(*v);
  return points;
}

std::vector<Index> spread_points(const morse::SurfaceDistances& distances, std::size_t count,
                                 RandomStream random) {
  return distances.farthest_points(static_cast<Index>(random.below(distances.vertex_count())), count);
}

}  // namespace morsel::tools
