#pragma once
/// Flooding and carving. For the module's own use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/levels.h"
#include "morsel/persistence/sweep.h"

namespace morsel::persistence::detail {

/// The kind that a vertex is to have after cancellation.
enum class Role : std::uint8_t { regular, minimum, maximum };  // regular: anything but an extremum

/// A field whose vertices have been given values of other vertices.
struct Releveled {
  std::vector<Index> place;   ///< per vertex: its rank in f, or the first rank of the level it was moved to
  std::vector<Level> levels;  ///< those that vertices were flooded or carved to, ascending
};

/// Floods f from the minima that `roles` names: each vertex rises to the lowest value over which it reaches
/// one. Then carves the result from the maxima that it names and from the boundary: each vertex falls to the
/// highest value over which it reaches one of these. (Reconstruction by erosion and by dilation: Vincent
/// 1993, "Morphological grayscale reconstruction in image analysis".) `sweeps` are f's. Needs a
/// minimum in every component, and a maximum in every closed one. Time: O(m α(m)) in the number of extrema,
/// and what is linear in the neighbourhood of the vertices that move; parallel over the regions that move.
Releveled reconstruct(const core::ScalarField& f, const Sweeps& sweeps, std::span<const Role> roles,
                      const core::Progress& progress);

}  // namespace morsel::persistence::detail
