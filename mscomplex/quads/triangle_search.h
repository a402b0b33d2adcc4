#pragma once
/// Distances to a triangle surface. Internal.

#include <span>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// Exact distances from points to a set of triangles, through a tree of boxes. Immutable; queries may come
/// from any number of threads.
class TriangleSearch {
 public:
  /// Copies the corners. O(n log n).
  TriangleSearch(std::span<const core::Point> positions, std::span<const core::Triangle> triangles);

  /// The distance from `x` to the nearest point of the triangles; infinite if there are none.
  double distance(const core::Point& x) const;
  /// That nearest point; there must be triangles.
  core::Point nearest(const core::Point& x) const;

 private:
  struct Box {
    core::Point min, max;
  };
  /// Replaces `best`, a square of a distance, and `at` if some triangle is nearer.
  void search(const core::Point& x, double& best, core::Point& at) const;
  void build(core::Index node, std::size_t first, std::size_t last, std::vector<core::Index>& order,
             const std::vector<core::Point>& middle);

  static constexpr std::size_t kLeaf = 4;
  std::vector<std::array<core::Point, 3>> corners_;  // in the order of leaves
  std::vector<Box> boxes_;  // of a node; children 2i + 1 and 2i + 2 split its range in half
};

}  // namespace morsel::mscomplex
