#pragma once
/// Sizes and borders of segments. For the module's own use.

#include "morsel/core/mesh/mesh.h"
#include "morsel/mscomplex/segments.h"

namespace morsel::mscomplex {

/// Computes the sizes, lengths and neighbours in `result` from the labels of triangles and vertices; its
/// segments must be set. O(n) except for sorting each segment's border, parallel, the same bits for every
/// number of threads.
void measure_segments(const core::TriangleMesh& mesh, Segments& result);

}  // namespace morsel::mscomplex
