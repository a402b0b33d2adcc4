#pragma once
/// Larger meshes from those at hand.

#include "support/meshes.h"

namespace morsel::test {

/// core::subdivided(), to be disturbed.
Soup refined(const TriangleMesh& mesh, int pieces);

/// Moves every coordinate by a seeded uniform random number of at most `share` of the mean edge length.
void add_noise(Soup& soup, double share, unsigned seed);

}  // namespace morsel::test
