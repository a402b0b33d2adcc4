#pragma once
/// The surface that a picture shows, in coordinates of its own size.

#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::tools::render {

/// A mesh moved and scaled so that its bounding box has its centre at 0 and the diagonal 1 (0 if all vertices
/// coincide). All lengths of this folder are in this unit. Copies are cheap but for the normals.
struct Body {
  core::TriangleMesh mesh;
  std::vector<core::Point> normals;  ///< unit, area-weighted, outward; zero where there is none
  double area;
};

/// Shares the connectivity. O(n).
Body make_body(const core::TriangleMesh& mesh);

}  // namespace morsel::tools::render
