#pragma once
/// Dijkstra's algorithm (1959), for whatever paths leave a vertex.

#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::morse {

/// Tentative distances of vertices, infinite at first, which only decrease until they are forgotten.
class ShortestPaths {
 public:
  explicit ShortestPaths(std::size_t vertices) : distance_(vertices, HUGE_VAL) {}

  /// Returns false if v is as near already.
  bool lower(core::Index v, double distance) {
    if (!(distance < distance_[v])) return false;
    distance_[v] = distance;
    queue_.emplace(distance, v);
    return true;
  }

  /// Calls spread(v, distance), which lowers the distances of others, for each vertex that was lowered since
  /// the last call, by ascending distance. O(k log k) for k that are lowered.
  template <class Spread>
  void run(const Spread& spread) {
    while (!queue_.empty()) {
      const auto [d, v] = queue_.top();
      queue_.pop();
      if (!(d > distance_[v])) spread(v, d);
    }
  }

  void forget(core::Index v) { distance_[v] = HUGE_VAL; }
  double distance(core::Index v) const { return distance_[v]; }
  const std::vector<double>& distances() const { return distance_; }

 private:
  using Entry = std::pair<double, core::Index>;
  std::vector<double> distance_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace morsel::morse
