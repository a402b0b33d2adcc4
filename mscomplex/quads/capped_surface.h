#pragma once
/// A bounded surface made closed, for layouts. Internal.

#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::mscomplex {

/// The surface with a collar along each boundary loop and a fan over it, the cap. Vertices and triangles keep
/// their numbers; those on the boundary are moved a little into the surface, so that nothing of the field
/// lies on the rim, where copies of them take their places. Then follow the vertices in the middles of
/// the caps, one for each loop.
struct CappedSurface {
  core::TriangleMesh mesh;
  std::vector<core::Index> cap_vertex;  ///< per loop
};

/// O(n). A closed surface is returned unchanged.
CappedSurface cap(const core::TriangleMesh& mesh);

}  // namespace morsel::mscomplex
