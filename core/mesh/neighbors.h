#pragma once
/// Radius search: the points within a distance of a position.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::core {

/// Radius search over a fixed set of points in ℝ³, by Euclidean distance in double precision. Keeps a copy of
/// the points. All queries may be made from any number of threads; copies share the tree.
class PointSearch {
 public:
  /// Builds a kd-tree; O(n log n) time, about 45 bytes a point. The points must be finite (a mesh's are) and
  /// fewer than kNone; throws InvalidArgument otherwise.
  explicit PointSearch(std::span<const Point> points);

  /// Replaces `found` by the numbers of all points x with ‖x − center‖ ≤ radius, ascending, so that sums over
  /// them always have the same roundings. Inclusive: the computed distance is compared with the radius, both
  /// as lengths, not squared, and neither overflows nor underflows. A point that is its own center is found
  /// at any radius ≥ 0; a negative or NaN radius finds nothing. O(log n + k log k) for k found.
  void within(const Point& center, double radius, std::vector<Index>& found) const;

  /// The distance from `center` to the `count`-th nearest point (≥ 1; infinite if there are fewer): within()
  /// finds at least `count` points at that radius, and more only in a tie. O(log n + count
  /// log count), more where many points coincide.
  double reach(const Point& center, std::size_t count) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace morsel::core
