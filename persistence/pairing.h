#pragma once
/// Extremum-saddle pairing.

#include "morsel/core/progress.h"
#include "morsel/core/scalar_field.h"
#include "morsel/persistence/diagram.h"

namespace morsel::persistence {

/// The persistence pairs of a piecewise-linear function on the capped surface, in the sense of its lower-star
/// filtration (Edelsbrunner, Letscher, Zomorodian 2002), pairs within one star left out. Sweeping up, the
/// components of the sublevel sets merge at saddles: the one with the higher minimum ends there (elder rule).
/// Sweeping down, the same for maxima and caps; a cap lies above every vertex, a cap of a later loop above
/// that of an earlier one. What is left of a saddle's multiplicity is essential.
///
/// Every vertex is labelled with the extremum at the end of its steepest path first; a run of a saddle's link
/// is connected, below the saddle, to the minimum of any of its vertices, so only saddles need union-find.
/// O(n) and O(s log s) in the number of saddles; the same result for every number of threads.
Diagram pair_extrema(const core::ScalarField& field, const core::Progress& progress = {});

}  // namespace morsel::persistence
