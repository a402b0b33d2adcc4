#pragma once
/// The same surface with more triangles.

#include "morsel/core/mesh/mesh.h"

namespace morsel::core {

/// The surface with every edge cut into `pieces` ≥ 1 equal ones and every triangle into pieces², in place:
/// the shape stays, n vertices become about pieces² · n. The mesh's vertices come first, then those on edges,
/// edge by edge, then those inside triangles. O(result). Throws InvalidArgument if there are no pieces,
/// BadInput if the result has too many triangles for a mesh.
TriangleMesh subdivided(const TriangleMesh& mesh, int pieces);

}  // namespace morsel::core
