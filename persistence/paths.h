#pragma once
/// Where steepest paths end. For the module's own use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh.h"

namespace morsel::persistence::detail {

using core::Index;

/// Up: basins of minima. Down: basins of maxima and caps.
enum class Direction : std::uint8_t { up, down };

/// The basins that steepest paths lead to, downwards for Direction::up and upwards for Direction::down. Only
/// the paths that are asked for are walked, each vertex once. Refers to mesh and ranks. Memory: 4 bytes a
/// vertex.
class SteepestPaths {
 public:
  /// `extremum` is the vertex of each basin, or the number of vertices + loop for a cap.
  SteepestPaths(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
                std::span<const Index> extremum);

  /// The basin of a vertex, or of a cap (given as in `extremum`). May be called from any number of threads,
  /// each with a buffer of its own, whose contents do not matter. Amortised O(degree).
  Index find(Index v, std::vector<Index>& buffer) const;

 private:
  template <Direction direction>
  Index walk(Index v, std::vector<Index>& buffer) const;

  const core::TriangleMesh& mesh_;
  std::span<const Index> rank_;
  Direction direction_;
  mutable std::vector<Index> basin_;  // per vertex and cap, kNone until it is known
};

}  // namespace morsel::persistence::detail
