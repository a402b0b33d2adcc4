#pragma once
/// Small random surfaces.

#include "support/meshes.h"

namespace morsel::test {

/// A seeded surface of some 4 to 100 vertices: a sphere, torus, slab with holes, disc or annulus, sometimes
/// two of them, with edges flipped at random (so that vertices of low and high degree come), triangles taken
/// out (holes of one or more triangles) and vertices renumbered.
TriangleMesh random_surface(unsigned seed);

}  // namespace morsel::test
