#pragma once
/// One sweep over a surface: the basins of its extrema and where they meet. For the module's own use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh.h"
#include "morsel/core/progress.h"
#include "morsel/core/scalar_field.h"
#include "morsel/persistence/diagram.h"

namespace morsel::persistence::detail {

/// Up: basins of minima. Down: basins of maxima and caps.
enum class Direction : std::uint8_t { up, down };

/// Two basins that meet at a saddle, if nothing joined them before.
struct Merge {
  Index saddle;
  Index a;
  Index b;
};

struct Saddle {
  Index vertex;
  Index multiplicity;
};

/// Basins are numbered from the eldest: minima by ascending rank, or caps from the last loop to the first and
/// then maxima by descending rank.
struct Sweep {
  Index vertex_count = 0;
  std::vector<Index> basin;     ///< per vertex: where its steepest path ends
  std::vector<Index> extremum;  ///< per basin: a vertex, or vertex_count + loop for a cap
  std::vector<Merge> merges;    ///< in the order of the sweep
  std::vector<Saddle> saddles;  ///< by ascending vertex

  Index basin_count() const { return static_cast<Index>(extremum.size()); }
  bool is_cap(Index b) const { return extremum[b] >= vertex_count; }
};

/// `rank` orders the vertices (a permutation). O(n), parallel, and a sort of the merges.
Sweep sweep(const core::TriangleMesh& mesh, std::span<const Index> rank, Direction direction,
            const core::Progress& progress = {});

/// For each basin that is not kept: the saddle at which, during the sweep, its component first meets one that
/// holds a kept basin, that is where it overflows when it is flooded (or carved). kNone for kept basins.
/// `kept` has one entry a basin, at least one of every component. O(m log m).
std::vector<Index> overflow_saddles(const Sweep& sweep, const std::vector<bool>& kept);

/// The diagram from both sweeps over the field.
Diagram pair_sweeps(const core::ScalarField& field, const Sweep& up, const Sweep& down);

}  // namespace morsel::persistence::detail
