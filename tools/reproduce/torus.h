#pragma once
/// The surface of the paper's section 3.1.

#include "morsel/core/mesh/mesh.h"

namespace morsel::tools::reproduce {

/// A torus that stands on its side: radii 1 and 0.4, its axis along y, 96 × 48 vertices. The height z has one
/// maximum, at its outer ring's highest vertex, one minimum, at the lowest, and two saddles on the inner
/// ring.
core::TriangleMesh standing_torus();

}  // namespace morsel::tools::reproduce
