#include "morsel/tools/study/matching.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "morsel/core/mesh/neighbors.h"
#include "morsel/core/parallel/stop.h"

namespace morsel::tools {
namespace {

using core::Index;
using morse::CriticalPoint;

/// Matches the remaining points of one type: the nearest pair first. Each reference point has one candidate
/// in the queue, its nearest free counterpart; where that was taken meanwhile, the next one is looked up. So
/// memory stays linear.
class NearestFirst {
 public:
  NearestFirst(const core::TriangleMesh& mesh, const std::vector<CriticalPoint>& reference,
               const std::vector<CriticalPoint>& other, double radius)
      : mesh_(mesh), reference_(reference), other_(other), radius_(radius) {}

  void match(const std::vector<std::size_t>& lost, const std::vector<std::size_t>& found,
             std::vector<Match>& moved) {
    if (lost.empty() || found.empty()) return;
    std::vector<core::Point> positions;
    positions.reserve(found.size());
    for (const std::size_t j : found) positions.push_back(mesh_.position(other_[j].vertex));
    const core::PointSearch search(positions);
    std::vector<bool> taken(found.size(), false);
    std::vector<Index> near;
    using Candidate =
        std::tuple<double, std::size_t, Index>;  // distance, reference point, position in `found`
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
    const auto propose = [&](std::size_t i) {
      core::throw_if_stopped();
      const core::Point& center = mesh_.position(reference_[i].vertex);
      search.within(center, radius_, near);
      Candidate best{radius_, i, core::kNone};
      for (const Index k : near)
        if (!taken[k]) best = std::min(best, Candidate{(positions[k] - center).norm(), i, k});
      if (std::get<2>(best) != core::kNone) queue.push(best);
    };
    for (const std::size_t i : lost) propose(i);
    while (!queue.empty()) {
      const auto [distance, i, k] = queue.top();
      queue.pop();
      if (taken[k]) {
        propose(i);
      } else {
        taken[k] = true;
        moved.push_back({i, found[k]});
      }
    }
  }

 private:
  const core::TriangleMesh& mesh_;
  const std::vector<CriticalPoint>& reference_;
  const std::vector<CriticalPoint>& other_;
  double radius_;
};

}  // namespace

Matching match_critical_points(const core::TriangleMesh& mesh, const morse::CriticalPoints& reference,
                               const morse::CriticalPoints& other, double radius) {
  const auto& a = reference.points;
  const auto& b = other.points;
  Matching matching;
  constexpr std::size_t kTypes = 4;
  std::vector<std::size_t> lost[kTypes];
  std::vector<std::size_t> found[kTypes];
  const auto lose = [&](std::size_t i) { lost[static_cast<std::size_t>(a[i].type)].push_back(i); };
  const auto find = [&](std::size_t j) { found[static_cast<std::size_t>(b[j].type)].push_back(j); };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].vertex < b[j].vertex)) {
      lose(i++);
    } else if (i == a.size() || b[j].vertex < a[i].vertex) {
      find(j++);
    } else {
      if (a[i].type == b[j].type) {
        matching.kept.push_back({i, j});
      } else {
        lose(i);
        find(j);
      }
      ++i;
      ++j;
    }
  }
  NearestFirst nearest(mesh, a, b, radius);
  for (std::size_t type = 0; type < kTypes; ++type) nearest.match(lost[type], found[type], matching.moved);
  matching.removed = a.size() - matching.kept.size() - matching.moved.size();
  matching.added = b.size() - matching.kept.size() - matching.moved.size();
  return matching;
}

}  // namespace morsel::tools
