#pragma once
/// Extremum-saddle pairing.

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/diagram.h"

namespace morsel::persistence {

/// The persistence pairs of a piecewise-linear function on the capped surface, in the sense of its lower-star
/// filtration (Edelsbrunner, Letscher, Zomorodian 2002), pairs within one star left out. Sweeping up, the
/// components of the sublevel sets merge at saddles: the one with the higher minimum ends there (elder rule).
/// Sweeping down, the same for maxima and caps; a cap lies above every vertex, a cap of a later loop above
/// that of an earlier one. The rest of a saddle's multiplicity is essential.
///
/// Only critical vertices count: they come from one pass over the triangles, and each end of a run in a
/// saddle's link is followed to an extremum, which is connected to it below (or above) the saddle. Union-find
/// over the extrema then takes the saddles in order (as extremum graphs do: Guillou, Vidal, Tierny 2023,
/// "Discrete Morse sandwich", for the pairs of extrema). O(n) and O(s α(s)) in the number of saddles,
/// parallel but for the union-find, whose two sweeps run side by side; the same result for every number of
/// threads. Temporary memory: some 20 bytes a vertex and 80 a saddle.
Diagram pair_extrema(const core::ScalarField& field, const core::Progress& progress = {});

}  // namespace morsel::persistence
