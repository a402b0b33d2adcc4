#pragma once
/// Larger meshes from those at hand.

#include "support/meshes.h"

namespace morsel::test {

/// The surface with every edge cut into `pieces` ≥ 1 equal ones and every triangle into pieces², in place: the shape
/// stays, n vertices become about pieces² · n. The mesh's vertices come first, then those on edges, edge by edge, then
/// those inside triangles.
Soup refined(const TriangleMesh& mesh, int pieces);

/// Moves every coordinate by a seeded uniform random number of at most `share` of the mean edge length.
void add_noise(Soup& soup, double share, unsigned seed);

}  // namespace morsel::test
