#include "morsel/tools/reproduce/region.h"

#include <utility>

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

ComparedRegion fullest_region(const core::TriangleMesh& mesh, const morse::CriticalPoints& all,
                              const morse::CriticalPoints& first, const morse::CriticalPoints& second,
                              const std::vector<bool>& places, const core::Length& radius) {
  const std::vector<Point> points = positions_of(mesh, all);
  const core::PointSearch near_all(points), near_first(positions_of(mesh, first)),
      near_second(positions_of(mesh, second));
  const double reach = radius.on(mesh);
  std::vector<Index> found;
  const auto count = [&](const core::PointSearch& search, const Point& center) {
    search.within(center, reach, found);
    return found.size();
  };

  ComparedRegion best;
  best.radius = radius;
  using Merit = std::pair<std::size_t, double>;  // larger is better
  Merit most{};
  for (Index v = 0; v < places.size(); ++v) {
    if (!places[v]) continue;
    const Point& center = mesh.position(v);
    const std::size_t of_first = count(near_first, center);
    const std::size_t of_second = count(near_second, center);
    ++best.places;
    best.more_of_first += of_first > of_second ? 1 : 0;
    best.more_of_second += of_second > of_first ? 1 : 0;
    const std::size_t of_all = count(near_all, center);
    double way = 0;
    for (const Index i : found) way += (points[i] - center).norm();
    const Merit merit{of_all, -way};
    if (best.vertex != core::kNone && merit <= most) continue;
    most = merit;
    best.vertex = v;
    best.all = of_all;
    best.first = of_first;
    best.second = of_second;
  }
  return best;
}

}  // namespace morsel::tools::reproduce
