#pragma once
/// Where two sets of critical points differ most.

#include <vector>

#include "morsel/tools/reproduce/outcome.h"

namespace morsel::tools::reproduce {

/// The vertex of `places` that has, within `radius`, most points of `first` more than of `second`; of equal
/// ones the one with the fewest of `second`, then the one nearest to the points of `first` (by the sum of the
/// distances), then that of the smallest number. `places` has an entry a vertex; vertex kNone if there is
/// none. O(n log n) and the points within the radius of each place.
ComparedRegion most_different_region(const core::TriangleMesh& mesh, const morse::CriticalPoints& first,
                                     const morse::CriticalPoints& second, const std::vector<bool>& places,
                                     const core::Length& radius);

}  // namespace morsel::tools::reproduce
