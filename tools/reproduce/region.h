#pragma once
/// Where two sets of critical points are compared, and how they differ all over a view.

#include <vector>

#include "morsel/tools/reproduce/outcome.h"

namespace morsel::tools::reproduce {

/// The vertex of `places` that has most points of `all` within `radius`, whatever the two others have there;
/// of equal ones the one nearest to these points (by the sum of the distances), then that of the smallest
/// number. `places` has an entry a vertex; vertex kNone if there is none. O(n log n) and the points within
/// the radius of each place.
ComparedRegion fullest_region(const core::TriangleMesh& mesh, const morse::CriticalPoints& all,
                              const morse::CriticalPoints& first, const morse::CriticalPoints& second,
                              const std::vector<bool>& places, const core::Length& radius);

}  // namespace morsel::tools::reproduce
