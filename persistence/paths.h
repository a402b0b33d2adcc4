#pragma once
/// The ends of monotone paths. For the module's own use.

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::persistence::detail {

using core::Index;

/// Up: basins of minima. Down: basins of maxima and caps.
enum class Direction : std::uint8_t { up, down };

/// Paths from vertices to extrema: downwards for Direction::up, upwards for Direction::down. A path follows
/// the last set_next(), or else the steepest edge. In which basin it ends depends on that, but all possible
/// ones are connected below (or above) its start, so the sweeps' result does not.
///
/// Paths are walked on demand, each vertex once. Refers to mesh and ranks. All members may
/// be called from any number of threads. Memory: 4 bytes a vertex.
class Paths {
 public:
  /// `extremum` is the vertex of each basin, or the number of vertices + loop for a cap.
  Paths(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
        std::span<const Index> extremum);

  /// `to` is a neighbour of v (or its cap) in the paths' direction. Before the first find().
  void set_next(Index v, Index to) { entry(v).store(to | kNext, std::memory_order_relaxed); }

  /// The basin of a vertex, or of a cap (given as in `extremum`). Each thread passes a buffer of its own,
  /// whose contents do not matter. Amortised O(degree).
  Index find(Index v, std::vector<Index>& buffer) const;

 private:
  static constexpr Index kNext = 0x8000'0000u;  // no mesh has that many vertices

  std::atomic_ref<Index> entry(Index v) const { return std::atomic_ref<Index>(entries_[v]); }

  const core::TriangleMesh& mesh_;
  std::span<const Index> rank_;
  Direction direction_;
  mutable std::vector<Index> entries_;  // per vertex and cap: its basin, kNext | the next element, or kNone
};

}  // namespace morsel::persistence::detail
