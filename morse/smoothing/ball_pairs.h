#pragma once
/// Pairs of points in blocks that lie within a radius of one another.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "morsel/morse/smoothing/block_tree.h"
#include "morsel/morse/smoothing/cell_pairs.h"
#include "morsel/morse/smoothing/pair_kernels.h"

namespace morsel::morse {

/// All pairs (v, x) of a chunk of consecutive blocks, its tiles, with ‖x − v‖ ≤ radius, each pair of points
/// once: v in a tile, x behind it in the tree's order. Most blocks within reach lie there wholly and are kept
/// as runs, 8 bytes each; the others have a bit per pair.
template <class Mask>
struct BallPairs {
  std::vector<std::uint32_t>
      reached;  ///< the blocks that occur, ascending, the tiles first; all else counts in these
  std::vector<std::uint32_t> runs;  ///< as in TilePairs
  std::vector<std::uint32_t> run_ends;
  std::vector<std::uint32_t> blocks;
  std::vector<Mask> masks;
  std::vector<std::uint32_t> block_ends;
  std::size_t most_blocks = 0;  ///< in `blocks` for one tile
  std::uint64_t pairs = 0;      ///< pairs (v, x), x ≠ v, in both directions

  std::size_t bytes() const;
  TilePairs<Mask> view() const;
};

/// Finds such pairs. The computed distance is compared with the radius as lengths, inclusively, in double
/// precision and with the same roundings for every instruction set. Reading is safe from any number of
/// threads.
template <class Mask>
class BallSearch {
 public:
  /// Mask has a bit for each of the tree's lanes. Pairs of `shared`, if not null, are left out. The tree and
  /// they must outlive this.
  BallSearch(const BlockTree& tree, double radius, const PairKernels& kernels,
             const CellPairs* shared = nullptr);

  /// The pairs of the tiles first … last − 1. Takes about as long as one pass over the pairs.
  BallPairs<Mask> find(std::size_t first, std::size_t last) const;

 private:
  struct Tile;
  void collect(std::size_t tile, Tile& found) const;
  void decide(std::size_t tile, Tile& found) const;

  const BlockTree& tree_;
  const CellPairs* shared_;
  CutFunction<Mask> cut_;
  double square_;  // the largest s whose square root, as computed, is at most the radius
};

extern template class BallSearch<std::uint8_t>;
extern template class BallSearch<std::uint16_t>;
extern template struct BallPairs<std::uint8_t>;
extern template struct BallPairs<std::uint16_t>;

}  // namespace morsel::morse
