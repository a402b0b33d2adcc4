#include "morsel/morse/operators/edge_paths.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

/// Tentative distances, which only decrease.
class Front {
 public:
  explicit Front(const TriangleMesh& mesh) : mesh_(mesh), distance_(mesh.vertex_count(), HUGE_VAL) {}

  /// Lowers the distances to those from v, calling visit(u) whenever it lowers one.
  template <class Visit>
  void spread_from(Index v, const Visit& visit) {
    lower(v, 0, visit);
    while (!queue_.empty()) {
      const auto [d, from] = queue_.top();
      queue_.pop();
      if (d > distance_[from]) continue;
      core::for_each_neighbor(mesh_, from, [&, d = d, from = from](Index u) {
        lower(u, d + (mesh_.position(u) - mesh_.position(from)).norm(), visit);
      });
    }
  }

  const std::vector<double>& distance() const { return distance_; }

 private:
  template <class Visit>
  void lower(Index u, double d, const Visit& visit) {
    if (d >= distance_[u]) return;
    distance_[u] = d;
    queue_.emplace(d, u);
    visit(u);
  }

  using Entry = std::pair<double, Index>;
  const TriangleMesh& mesh_;
  std::vector<double> distance_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

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
  Front front(mesh);
  for (const Index s : sources) front.spread_from(s, [](Index) {});
  return front.distance();
}

FarthestPoints farthest_points(const TriangleMesh& mesh, std::size_t count) {
  FarthestPoints result;
  result.nearest.assign(mesh.vertex_count(), 0);
  Front front(mesh);
  const std::vector<double>& distance = front.distance();
  for (Index next = farthest_from_centre(mesh);;) {
    const auto number = static_cast<Index>(result.points.size());
    result.points.push_back(next);
    front.spread_from(next, [&](Index v) { result.nearest[v] = number; });
    next = static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (number == 0) result.reach = distance[next];
    if (result.points.size() == count || distance[next] == 0) return result;
  }
}

}  // namespace morsel::morse
