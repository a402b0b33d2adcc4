#pragma once
/// Distances between all vertices by brute force, for tests of distances along a surface.

#include <vector>

#include "support/meshes.h"

namespace morsel::test {

/// The lengths of the shortest paths along edges and straight across two triangles that share an edge, by
/// rows; infinite where there is none. Triangles are compared two by two and unfolded by the angles at the
/// edge they share; then Floyd, Warshall. O(n³).
std::vector<std::vector<double>> all_distances(const TriangleMesh& mesh);

}  // namespace morsel::test
