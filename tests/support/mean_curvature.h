#pragma once
/// Taubin's mean curvature written down plainly, and a reader for plain OFF files: what regressions on real
/// meshes need without the modules that do these for users.

#include <string>
#include <vector>

#include "support/meshes.h"

namespace morsel::test {

/// H = Σ_j w_ij κ_ij per vertex (Taubin 1995) as the project defines it: area-weighted vertex normals,
/// weights by the areas of the triangles at each edge.
std::vector<double> plain_mean_curvature(const TriangleMesh& mesh);

/// A triangle mesh from an OFF file without comments or colours; throws std::runtime_error on anything else.
TriangleMesh read_plain_off(const std::string& path);

}  // namespace morsel::test
