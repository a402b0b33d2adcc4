#include "morsel/tools/reproduce/region.h"

#include <tuple>

#include "morsel/core/mesh/neighbors.h"

namespace morsel::tools::reproduce {
namespace {

using core::Index;
using core::Point;

std::vector<Point> positions_of(const core::TriangleMesh& mesh, const morse::CriticalPoints& points) {
  std::vector<Point> positions;
  positions.reserve(points.points.size());
  for (const morse::CriticalPoint& point : points.points) positions.push_back(mesh.position(point.vertex));
  return positions;
}

}  // namespace

ComparedRegion most_different_region(const core::TriangleMesh& mesh, const morse::CriticalPoints& first,
                                     const morse::CriticalPoints& second, const std::vector<bool>& places,
                                     const core::Length& radius) {
  const std::vector<Point> a = positions_of(mesh, first);
  const std::vector<Point> b = positions_of(mesh, second);
  const core::PointSearch near_a(a), near_b(b);
  const double reach = radius.on(mesh);

  ComparedRegion best{core::kNone, radius, 0, 0};
  using Merit = std::tuple<std::ptrdiff_t, std::ptrdiff_t, double>;  // larger is better
  Merit most{};
  std::vector<Index> found;
  for (Index v = 0; v < places.size(); ++v) {
    if (!places[v]) continue;
    const Point& center = mesh.position(v);
    near_b.within(center, reach, found);
    const auto of_b = static_cast<std::ptrdiff_t>(found.size());
    near_a.within(center, reach, found);
    const auto of_a = static_cast<std::ptrdiff_t>(found.size());
    double way = 0;
    for (const Index i : found) way += (a[i] - center).norm();
    const Merit merit{of_a - of_b, -of_b, -way};
    if (best.vertex != core::kNone && merit <= most) continue;
    most = merit;
    best.vertex = v;
    best.first = static_cast<std::size_t>(of_a);
    best.second = static_cast<std::size_t>(of_b);
  }
  return best;
}

}  // namespace morsel::tools::reproduce
