#include "morsel/core/mesh/mesh.h"

#include <catch2/catch.hpp>

#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;

TEST_CASE("every family of meshes passes validate()") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    CHECK_NOTHROW(entry.mesh.validate());
  }
}

TEST_CASE("topology of the families") {
  struct Expected {
    Soup soup;
    long euler;
    Index genus, loops, components;
  };
  const std::vector<Expected> table = {
      {tetrahedron(), 2, 0, 0, 1},
      {single_triangle(), 1, 0, 1, 1},
      {sphere(1), 2, 0, 0, 1},
      {torus(5, 4), 0, 1, 0, 1},
      {pierced_slab(2), -2, 2, 0, 1},
      {pierced_slab(5), -8, 5, 0, 1},
      {annulus(5, 3), 0, 0, 2, 1},
      {punctured_sphere(2, 5), -3, 0, 5, 1},
      {together(sphere(0), torus(4, 4)), 2, 1, 0, 2},
  };
  for (const Expected& e : table) {
    const TriangleMesh mesh = e.soup.mesh();
    CHECK(mesh.euler_characteristic() == e.euler);
    CHECK(mesh.genus() == e.genus);
    CHECK(mesh.boundary_loop_count() == e.loops);
    CHECK(mesh.component_count() == e.components);
  }
}
