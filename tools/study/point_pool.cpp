#include "morsel/tools/study/point_pool.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace morsel::tools {
namespace {

using core::Index;
using core::Point;

bool is_nearer(const PointPool::Found& a, const PointPool::Found& b) {
  return std::pair(a.distance, a.point) < std::pair(b.distance, b.point);
}

}  // namespace

/// The nearest points so far, a heap with the farthest first.
struct PointPool::Query {
  Point center;
  double radius;
  std::size_t count;
  std::vector<Found>& found;

  bool is_full() const { return found.size() == count; }
  /// Whether no point of the node can be among the nearest; its distance is rounded.
  bool excludes(const Node& node) const {
    const double distance = distance_to(node);
    return distance * (1 - 1e-9) > radius || (is_full() && distance >= found.front().distance);
  }
  double distance_to(const Node& node) const {
    return (center.cwiseMax(node.low).cwiseMin(node.high) - center).norm();
  }
  void offer(const Found& candidate) {
    if (!(candidate.distance <= radius)) return;
    if (is_full()) {
      if (!is_nearer(candidate, found.front())) return;
      std::pop_heap(found.begin(), found.end(), is_nearer);
      found.pop_back();
    }
    found.push_back(candidate);
    std::push_heap(found.begin(), found.end(), is_nearer);
  }
};

PointPool::PointPool(std::vector<Point> points)
    : points_(std::move(points)),
      order_(points_.size()),
      place_(points_.size()),
      removed_(points_.size(), false) {
  std::iota(order_.begin(), order_.end(), Index{0});
  if (!points_.empty()) build({0, 0, points_.size()});
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = static_cast<Index>(i);
}

void PointPool::build(const Range& range) {
  if (nodes_.size() <= range.node) nodes_.resize(range.node + 1);
  const auto first = order_.begin() + static_cast<std::ptrdiff_t>(range.first);
  const auto last = order_.begin() + static_cast<std::ptrdiff_t>(range.last);
  Point low = points_[*first];
  Point high = low;
  for (auto i = first; i != last; ++i) {
    low = low.cwiseMin(points_[*i]);
    high = high.cwiseMax(points_[*i]);
  }
  nodes_[range.node] = {low, high, range.last - range.first};
  if (range.is_leaf()) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(
      first, order_.begin() + static_cast<std::ptrdiff_t>(range.child(0).last), last,
      [&](Index a, Index b) { return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b); });
  build(range.child(0));
  build(range.child(1));
}

void PointPool::nearest(const Point& center, double radius, std::size_t count,
                        std::vector<Found>& found) const {
  found.clear();
  if (points_.empty() || count == 0) return;
  Query query{center, radius, count, found};
  search({0, 0, points_.size()}, query);
  std::sort_heap(found.begin(), found.end(), is_nearer);
}

void PointPool::search(const Range& range, Query& query) const {
  const Node& node = nodes_[range.node];
  if (node.left == 0 || query.excludes(node)) return;
  if (range.is_leaf()) {
    for (std::size_t i = range.first; i < range.last; ++i)
      if (const Index point = order_[i]; !removed_[point])
        query.offer({(points_[point] - query.center).norm(), point});
    return;
  }
  const Range low = range.child(0);
  const Range high = range.child(1);
  const bool low_first = query.distance_to(nodes_[low.node]) <= query.distance_to(nodes_[high.node]);
  search(low_first ? low : high, query);
  search(low_first ? high : low, query);
}

void PointPool::remove(Index point) {
  removed_[point] = true;
  for (Range range{0, 0, points_.size()};;) {
    --nodes_[range.node].left;
    if (range.is_leaf()) return;
    const Range low = range.child(0);
    range = place_[point] < low.last ? low : range.child(1);
  }
}

}  // namespace morsel::tools
