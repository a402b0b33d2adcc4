#pragma once
/// Which vertices are critical, by one pass over the triangles. For the module's own use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh.h"

namespace morsel::persistence::detail {

using core::Index;

/// What the number of changes between lower and higher around a vertex of the capped surface can be, as far
/// as it matters: it is even, and 2 (k − 1) + 2 at a saddle of k runs.
inline constexpr std::uint8_t kExtremum = 0;
inline constexpr std::uint8_t kRegular = 2;
inline constexpr std::uint8_t kSaddle = 4;  // or more

/// For each vertex how often lower and higher elements of its link follow one another, cut off at kSaddle. A
/// triangle is such a change for the middle one of its vertices, so no link needs to be walked (Banchoff's
/// index, 1970). `rank` orders the vertices (a permutation). O(n), parallel; a byte a vertex and slice.
std::vector<std::uint8_t> link_changes(const core::TriangleMesh& mesh, std::span<const Index> rank);

}  // namespace morsel::persistence::detail
