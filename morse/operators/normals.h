#pragma once
/// Which side of a surface is its outside.

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// Per component, the factor that makes the triangles' normals point out of the solid: the orientation of the
/// triangles is the file's own, so that the wall of a cavity has the sign of a wall, and it is turned, −1 for
/// all closed components, where the outermost of them are all inside out (of negative volume). Bounded
/// components keep the orientation of their triangles. Where closed components of both orientations occur, an
/// outermost one is one whose box lies in that of no other (core/mesh/nesting.h). O(triangles), and then
/// O(components²) at worst.
std::vector<double> outward_signs(const core::TriangleMesh& mesh);

/// What outward_signs() turned, or found inside out and did not turn, and bounded components whose outside
/// cannot be told, in a sentence each. A bounded component's outside is told where it encloses a quarter of a
/// sphere's volume or more once its boundary is closed. As outward_signs(), O(triangles) more.
std::vector<std::string> orientation_warnings(const core::TriangleMesh& mesh);

/// Unit normals at the vertices: the triangles' area vectors summed, outward as above. Zero where a vertex
/// has no area around it, or where normals cancel out. The mesh should be of about unit size (unit_sized()).
/// O(n), parallel.
std::vector<core::Point> vertex_normals(const core::TriangleMesh& mesh);

}  // namespace morsel::morse
