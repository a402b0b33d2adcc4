#pragma once
/// Points in blocks of a few neighbours each, and a tree of boxes over the blocks.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"
#include "morsel/morse/smoothing/aligned.h"

namespace morsel::morse {

/// An axis-aligned box.
struct BlockBox {
  std::array<double, 3> low;
  std::array<double, 3> high;
};

/// The squares of the smallest and of the largest distance that points of two boxes may have.
struct SquareSpan {
  double least, most;
};
SquareSpan squares_between(const BlockBox& a, const BlockBox& b);

/// Sorts points by halving them recursively across the longest side of their box, down to blocks of
/// `lanes` points (the last one may have fewer), so that blocks, and runs of blocks, are compact in space. A
/// range of blocks [first, last) of the tree has the halves [first, middle) and [middle, last), where middle
/// is the mean, rounded down. Coordinates are divided by a power of two that brings them to order 1: this
/// changes no digit, and squares of distances neither overflow nor underflow.
class BlockTree {
 public:
  /// O(n log n), parallel; the order depends on the points alone. The points must be finite.
  BlockTree(std::span<const core::Point> points, std::size_t lanes, const core::Progress& progress);

  std::size_t lanes() const { return lanes_; }
  std::size_t size() const { return order_.size(); }
  std::size_t block_count() const { return leaf_boxes_.size(); }
  /// How many points a block holds: lanes, but for the last one.
  std::size_t points_in(std::size_t block) const {
    return block + 1 < block_count() ? lanes_ : size() - block * lanes_;
  }
  /// The points' numbers, block after block.
  std::span<const core::Index> order() const { return order_; }
  /// Block b's scaled coordinates: lanes x, lanes y, lanes z; a short block repeats its last point.
  const double* coordinates(std::size_t block) const { return &coordinates_[3 * lanes_ * block]; }
  /// The box of a range of the tree, in scaled coordinates.
  const BlockBox& box(std::size_t first, std::size_t last) const {
    return last - first == 1 ? leaf_boxes_[first] : inner_boxes_[(first + last) / 2];
  }
  /// Coordinates were divided by 2 to this.
  int exponent() const { return exponent_; }

 private:
  struct Item {
    std::array<double, 3> at;
    core::Index point;
  };
  void split(std::vector<Item>& items, const core::Progress& progress);

  std::size_t lanes_;
  int exponent_ = 0;
  std::vector<core::Index> order_;
  AlignedVector<double> coordinates_;
  std::vector<BlockBox> leaf_boxes_;
  std::vector<BlockBox> inner_boxes_;  // by the middle of the range, which no two ranges share
};

}  // namespace morsel::morse
