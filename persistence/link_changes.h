#pragma once
/// Which vertices are critical, by one pass over the triangles. For the module's own use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh.h"

namespace morsel::persistence::detail {

using core::Index;

/// Numbers of changes that tell what a vertex is; a saddle of multiplicity m has 2 m + 2.
inline constexpr std::uint8_t kExtremum = 0;
inline constexpr std::uint8_t kRegular = 2;
inline constexpr std::uint8_t kMostChanges = 254;  ///< or more

/// For each vertex how often lower and higher elements of its link on the capped surface follow one another,
/// cut off at kMostChanges. A triangle is such a change for the middle one of its vertices, so no link needs
/// to be walked (Banchoff, "Critical points and curvature for embedded polyhedral surfaces", 1970). `rank`
/// orders the vertices (a permutation). O(n), parallel; at most 8 bytes a vertex.
std::vector<std::uint8_t> link_changes(const core::TriangleMesh& mesh, std::span<const Index> rank);

}  // namespace morsel::persistence::detail
