#include "morsel/mscomplex/graph.h"

#include <boost/graph/connected_components.hpp>
#include <catch2/catch.hpp>
#include <vector>

#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::MorseSmaleComplex;

TEST_CASE("the graph of the complex") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const MorseSmaleComplex complex(ScalarField(entry.mesh, random_values(entry.mesh.vertex_count(), 61)));
    const mscomplex::MorseSmaleGraph graph = mscomplex::graph(complex);
    REQUIRE(boost::num_vertices(graph) == complex.node_count());
    REQUIRE(boost::num_edges(graph) == complex.arc_count());
    Index arc = 0;
    for (auto [edge, end] = boost::edges(graph); edge != end; ++edge, ++arc) {
      CHECK(graph[*edge].arc == arc);
      CHECK(graph[*edge].kind == MorseSmaleComplex::arc_kind(arc));
      CHECK(boost::source(*edge, graph) == complex.arc_saddle(arc));
      CHECK(boost::target(*edge, graph) == complex.arc_end(arc));
    }
    for (Index n = 0; n < complex.node_count(); ++n) {
      Index degree = 0;
      complex.for_each_arc_around(n, [&](Index) { ++degree; });
      CHECK(boost::out_degree(n, graph) == degree);
      CHECK(graph[n].vertex == complex.node(n).vertex);
    }
    // A component of the surface with saddles is one of the graph; one without falls into minimum and top.
    std::vector<int> component(complex.node_count());
    const auto components = static_cast<Index>(boost::connected_components(graph, component.data()));
    CHECK(components >= entry.mesh.component_count());
    CHECK(components <= 2 * entry.mesh.component_count());
  }
}
