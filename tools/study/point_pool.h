#pragma once
/// Points of which the nearest are looked up, and which are removed one by one. Internal.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::tools {

/// A kd-tree over points that may be removed. Not for use by several threads at once.
class PointPool {
 public:
  /// A point, by its place in the list given, and its distance.
  struct Found {
    double distance;
    core::Index point;
  };

  /// O(n log n), about 60 bytes a point.
  explicit PointPool(std::vector<core::Point> points);

  /// Replaces `found` by the nearest of the points that are left, up to `count`, within the radius
  /// (inclusive), nearest first; of equally near ones the first in the list come first. About O(log n) for
  /// each.
  void nearest(const core::Point& center, double radius, std::size_t count, std::vector<Found>& found) const;

  /// Removes a point that is there. O(log n).
  void remove(core::Index point);

 private:
  struct Node {
    core::Point low, high;  // of its points at the start
    std::size_t left = 0;   // points that are left
  };
  struct Range {
    std::size_t node, first, last;
    bool is_leaf() const { return last - first <= kLeaf; }
    Range child(int side) const {
      const std::size_t middle = (first + last) / 2;
      return side == 0 ? Range{2 * node + 1, first, middle} : Range{2 * node + 2, middle, last};
    }
  };
  static constexpr std::size_t kLeaf = 8;

  struct Query;
  void build(const Range& range);
  void search(const Range& range, Query& query) const;

  std::vector<core::Point> points_;
  std::vector<core::Index> order_;  // of the points in the tree
  std::vector<core::Index> place_;  // of each point in that order
  std::vector<bool> removed_;       // by point
  std::vector<Node> nodes_;         // a node's children are 2 i + 1 and 2 i + 2
};

}  // namespace morsel::tools
