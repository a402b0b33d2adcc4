#pragma once
/// Sizes and borders of segments. For the module's own use.

#include "morsel/core/mesh/mesh.h"
#include "morsel/mscomplex/segments.h"

namespace morsel::mscomplex {

/// Fills in, from the labels of triangles and vertices, what `result` says of sizes, lengths and neighbours;
/// its segments must be there. O(n) but for sorting each segment's border, parallel, the same bits for every
/// number of threads.
void measure_segments(const core::TriangleMesh& mesh, Segments& result);

}  // namespace morsel::mscomplex
