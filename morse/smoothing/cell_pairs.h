#pragma once
/// Pairs of small cells that lie within a radius of one another as a whole.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/block_tree.h"

namespace morsel::morse {

/// The cells of one depth of a block tree, and for each of them the cells of that depth with which it is a
/// pair.
struct CellLayer {
  int order = 0;                      ///< of the expansion of the weight of distances
  std::size_t points = 0;             ///< a cell holds, about
  std::vector<std::uint32_t> firsts;  ///< cell c has the blocks firsts[c] … firsts[c + 1] − 1
  std::vector<std::uint32_t> pair_ends;
  std::vector<std::uint32_t> partners;  ///< of cell c: up to pair_ends[c]; each pair is in both lists

  std::size_t size() const { return pair_ends.size(); }
  std::span<const std::uint32_t> partners_of(std::size_t cell) const {
    const std::size_t begin = cell == 0 ? 0 : pair_ends[cell - 1];
    return {partners.data() + begin, pair_ends[cell] - begin};
  }
};

/// Splits all pairs of points within a radius into pairs of cells and a rest. Two cells of the same depth are
/// a pair if every two of their points lie within the radius, if the Gaussian of the distance is within
/// `tolerance` of its Taylor polynomial of the depth's order about the centres, relatively, and if none of
/// the cells that contain them are a pair. A depth is used where that takes less work than visiting the pairs
/// of points.
class CellPairs {
 public:
  struct Options {
    double radius;
    double sigma;
    double tolerance;
    int panels;  ///< how many vectors of 16 floats the work is done on
  };

  /// O(n · neighbours / cell), parallel. The tree must outlive this; blocks must have 16 points.
  CellPairs(const BlockTree& tree, const Options& options, const core::Progress& progress);

  /// Only those with pairs.
  std::span<const CellLayer> layers() const { return layers_; }
  /// The ranges of blocks that contain the rest of the points within reach of a block, ascending; all blocks
  /// if there are no layers.
  void rest(std::size_t block, std::vector<std::pair<std::uint32_t, std::uint32_t>>& ranges) const;
  /// Pairs of points (v, x) in pairs of cells.
  std::uint64_t point_pairs() const;
  /// Nanoseconds a pass takes, roughly, on one core of 2023; by counts alone, so the same everywhere.
  double cost() const { return cost_; }
  /// Of that, what the rest takes.
  double rest_cost() const { return rest_cost_; }
  /// The same if every pair of points is visited.
  double cost_without() const { return cost_without_; }

  /// Taylor polynomials of e^{−|x|²/2} of this order or below are available.
  static constexpr int kLeastOrder = 3;
  static constexpr int kMostOrder = 6;

 private:
  struct Depth;
  /// Splits the rest among the cells of the next depth.
  void add(Depth depth, const Options& options);

  const BlockTree& tree_;
  std::vector<CellLayer> layers_;
  std::vector<std::uint32_t> firsts_;  // of the deepest cells that were visited
  std::vector<std::uint32_t> rest_ends_;
  std::vector<std::uint32_t> rest_;  // cells of that depth
  double cost_ = 0;
  double rest_cost_ = 0;
  double cost_without_ = 0;
};

}  // namespace morsel::morse
