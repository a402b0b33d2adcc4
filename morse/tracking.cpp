#include "morsel/morse/tracking.h"

#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "morsel/core/field/link.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::kNone;

/// Follows highest (rising) or lowest neighbours to a vertex without a higher (lower) one.
Index climb(const core::ScalarField& field, Index v, bool rising) {
  for (;;) {
    Index best = v;
    core::for_each_neighbor(field.mesh(), v, [&](Index u) {
      if (rising ? field.is_lower(best, u) : field.is_lower(u, best)) best = u;
    });
    if (best == v) return v;
    v = best;
  }
}

/// The vertex nearest to v along edges that satisfies `wanted`, the smallest of equally near ones; kNone if
/// there is none within `reach` (Dijkstra).
template <class Wanted>
Index nearest(const core::TriangleMesh& mesh, Index v, double reach, const Wanted& wanted) {
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::unordered_map<Index, double> distance = {{v, 0.0}};
  queue.emplace(0.0, v);
  while (!queue.empty()) {
    const double d = queue.top().first;
    const Index u = queue.top().second;
    queue.pop();
    if (d > distance.at(u)) continue;
    if (wanted(u)) return u;
    core::for_each_neighbor(mesh, u, [&](Index w) {
      const double further = d + (mesh.position(w) - mesh.position(u)).norm();
      if (further > reach) return;
      const auto [entry, is_new] = distance.try_emplace(w, further);
      if (!is_new && entry->second <= further) return;
      entry->second = further;
      queue.emplace(further, w);
    });
  }
  return kNone;
}

}  // namespace

CriticalPointTracker::CriticalPointTracker(const core::ScalarField& input, double reach,
                                           const core::Progress& progress)
    : CriticalPointTracker(std::make_shared<core::ScalarField>(input), reach, progress) {}

CriticalPointTracker::CriticalPointTracker(std::shared_ptr<const core::ScalarField> input, double reach,
                                           const core::Progress& progress)
    : field_(std::move(input)), reach_(reach), progress_(progress), points_(classify(*field_, progress)) {
  for (const CriticalPoint& point : points_.points) origins_.push_back(point.vertex);
}

Index CriticalPointTracker::previous(const CriticalPoint& point, std::span<const CriticalType> types) const {
  const auto same_type = [&](Index v) { return types[v] == point.type; };
  if (same_type(point.vertex)) return point.vertex;
  if (point.type == CriticalType::saddle) return nearest(field_->mesh(), point.vertex, reach_, same_type);
  const Index end = climb(*field_, point.vertex, point.type == CriticalType::maximum);
  const core::TriangleMesh& mesh = field_->mesh();
  const bool near = (mesh.position(end) - mesh.position(point.vertex)).norm() <= reach_;
  return near && same_type(end) ? end : kNone;
}

void CriticalPointTracker::advance(const core::ScalarField& next) {
  const std::size_t n = next.values().size();
  std::vector<CriticalType> types(n, CriticalType::regular);
  std::vector<Index> origin_of(n, kNone);
  for (std::size_t i = 0; i < points_.points.size(); ++i) {
    types[points_.points[i].vertex] = points_.points[i].type;
    origin_of[points_.points[i].vertex] = origins_[i];
  }
  CriticalPoints points = classify(next, progress_);
  std::vector<Index> origins(points.points.size());
  core::parallel_for(0, origins.size(), 16, [&](std::size_t first, std::size_t last) {
    progress_.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      const Index before = previous(points.points[i], types);
      origins[i] = before == kNone ? kNone : origin_of[before];
    }
  });
  field_ = std::make_shared<core::ScalarField>(next);
  points_ = std::move(points);
  origins_ = std::move(origins);
}

}  // namespace morsel::morse
