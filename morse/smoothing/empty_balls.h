#pragma once
/// Balls around vertices in which smoothing finds no neighbour. Internal.

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// Says so if most balls of `radius` around vertices hold no other vertex, where smoothing does nothing.
std::vector<std::string> empty_ball_warnings(const core::TriangleMesh& mesh, double radius);

}  // namespace morsel::morse
