#include "morsel/mscomplex/complex.h"

#include <catch2/catch.hpp>
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::MorseSmaleComplex;

TEST_CASE("the complex keeps every invariant") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {21u, 22u, 23u, 24u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        const MorseSmaleComplex complex(f.field);
        REQUIRE_NOTHROW(complex.validate());
      }
}
