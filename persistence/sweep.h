#pragma once
/// The union-find sweeps over a surface, from below and from above: the basins of its extrema and where they
/// meet. For the module's own use.

#include <memory>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/diagram.h"
#include "morsel/persistence/elder_rule.h"
#include "morsel/persistence/link_ends.h"
#include "morsel/persistence/paths.h"

namespace morsel::persistence::detail {

/// One of the two sweeps. Basins are numbered from the eldest; the saddles of merges and deaths are their
/// ranks.
struct Sweep {
  Index vertex_count = 0;
  std::vector<Index> extremum;  ///< per basin: a vertex, or vertex_count + loop for a cap
  std::vector<Merge> merges;    ///< as left by apply_elder_rule()
  std::vector<Death> deaths;
  std::unique_ptr<Paths> paths;

  Index basin_count() const { return static_cast<Index>(extremum.size()); }
  bool is_cap(Index b) const { return extremum[b] >= vertex_count; }
};

struct Sweeps {
  std::vector<Saddle> saddles;  ///< by ascending rank
  Sweep up;                     ///< the basins of minima
  Sweep down;                   ///< the basins of maxima and caps
};

/// O(n) and O(s α(s)) in the number of saddles, all of it parallel but the union-find. The result refers to
/// the field.
Sweeps sweep(const core::ScalarField& field, const core::Progress& progress = {});

/// The diagram of the field from its sweeps, but with the finite pairs in the order of the sweeps; O(n).
Diagram unsorted_diagram(const core::ScalarField& field, const Sweeps& sweeps);

/// Sorts the pairs of such a diagram into the order of Diagram::pairs; O(s).
void sort_pairs(Diagram& diagram);

}  // namespace morsel::persistence::detail
