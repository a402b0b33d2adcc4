#pragma once
/// Which side of a surface is its outside.

#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// Per component, −1 where a closed one is turned inside out (negative volume) and 1 elsewhere: the factor
/// that makes the triangles' normals point outward. Bounded components keep the orientation of their
/// triangles. O(triangles).
std::vector<double> outward_signs(const core::TriangleMesh& mesh);

/// Unit normals at the vertices: the triangles' area vectors summed, outward as above. Zero where a vertex
/// has no area around it, or where normals cancel out. The mesh should be of about unit size (unit_sized()).
/// O(n), parallel.
std::vector<core::Point> vertex_normals(const core::TriangleMesh& mesh);

}  // namespace morsel::morse
