#pragma once
/// Matching of the critical points of two fields.

#include <cstddef>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/critical_points.h"

namespace morsel::tools {

/// A reference point and its counterpart, as positions in the two lists of critical points.
struct Match {
  std::size_t reference;
  std::size_t other;
};

struct Matching {
  std::vector<Match> kept;   ///< same type at the same vertex
  std::vector<Match> moved;  ///< same type, nearest first, within the radius
  std::size_t added = 0;     ///< points of `other` without a counterpart
  std::size_t removed = 0;   ///< points of `reference` without one
};

/// Matches the points one to one: first those of the same type at the same vertex, then, type by type, always
/// the nearest pair that is left within `radius` (Euclidean; ties by the vertices' numbers). Both lists
/// ascend by vertex. O(m log m + m k), m points with k others in reach; memory O(m).
Matching match_critical_points(const core::TriangleMesh& mesh, const morse::CriticalPoints& reference,
                               const morse::CriticalPoints& other, double radius);

/// The radius that reports use: 2 % of the square root of the surface's area, which is the same however the
/// mesh is turned.
inline double matching_radius(const core::TriangleMesh& mesh) { return 0.02 * core::root_area(mesh); }

}  // namespace morsel::tools
