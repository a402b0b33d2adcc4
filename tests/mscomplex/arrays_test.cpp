#include "morsel/mscomplex/arrays.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "morsel/core/parallel/parallel.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using mscomplex::MorseSmaleComplex;

namespace {

void check_arrays(const MorseSmaleComplex& complex) {
  const auto nodes = mscomplex::nodes_of(complex);
  REQUIRE(nodes.size() == complex.node_count());
  for (core::Index i = 0; i < nodes.size(); ++i) {
    const mscomplex::Node node = complex.node(i);
    CHECK((nodes[i].kind == node.kind && nodes[i].cell == node.cell && nodes[i].vertex == node.vertex &&
           nodes[i].value == node.value));
  }
  const auto arcs = mscomplex::arcs_of(complex);
  const mscomplex::Polylines lines = mscomplex::polylines_of(complex);
  REQUIRE(arcs.size() == complex.arc_count());
  REQUIRE(lines.offsets.size() == arcs.size() + 1);
  CHECK(lines.offsets.back() == lines.points.size());
  std::vector<core::Point> traced;
  for (core::Index i = 0; i < arcs.size(); ++i) {
    const mscomplex::Arc arc = complex.arc(i);
    CHECK((arcs[i].saddle == arc.saddle && arcs[i].end == arc.end && arcs[i].kind == arc.kind));
    complex.trace(i, traced);
    REQUIRE(lines.offsets[i + 1] - lines.offsets[i] == traced.size());
    CHECK(std::equal(traced.begin(), traced.end(), lines.points.begin() + lines.offsets[i]));
  }
  const auto quads = mscomplex::quads_of(complex);
  REQUIRE(quads.size() == complex.quad_count());
  for (core::Index i = 0; i < quads.size(); ++i) {
    const mscomplex::Quad quad = complex.quad(i);
    CHECK((quads[i].nodes == quad.nodes && quads[i].arcs == quad.arcs));
  }
}

}  // namespace

TEST_CASE("arrays of a complex without arcs are empty, but for its two nodes") {
  const MorseSmaleComplex complex(core::ScalarField(octahedron().mesh(), {9, -9, 1, 2, 3, 4}));
  CHECK(mscomplex::nodes_of(complex).size() == 2);
  CHECK(mscomplex::arcs_of(complex).empty());
  CHECK(mscomplex::quads_of(complex).empty());
  const mscomplex::Polylines lines = mscomplex::polylines_of(complex);
  CHECK(lines.points.empty());
  CHECK(lines.offsets == std::vector<std::size_t>{0});
}

TEST_CASE("arrays have what the complex has one by one, closed and bounded, at any number of threads") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const MorseSmaleComplex complex(core::ScalarField(mesh, random_values(mesh.vertex_count(), 7)));
    for (const int threads : {1, 3}) {
      const core::ThreadLimit limit(threads);
      check_arrays(complex);
    }
  }
}
