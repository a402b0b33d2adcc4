#include "morsel/mscomplex/complex.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::MorseSmaleComplex;
using mscomplex::Node;
using mscomplex::NodeKind;
using mscomplex::Quad;

namespace {

std::vector<Index> ends_of(const MorseSmaleComplex& complex, Index saddle) {
  std::vector<Index> ends;
  for (Index k = 0; k < 4; ++k) ends.push_back(complex.arc_end(4 * saddle + k));
  return ends;
}

bool is_at(const Point& a, const Point& b) { return a == b; }

bool same_bits(const MorseSmaleComplex& a, const MorseSmaleComplex& b) {
  if (a.node_count() != b.node_count() || a.arc_count() != b.arc_count()) return false;
  for (Index n = 0; n < a.node_count(); ++n) {
    const Node x = a.node(n);
    const Node y = b.node(n);
    if (x.kind != y.kind || x.cell != y.cell || x.vertex != y.vertex || x.value != y.value) return false;
    if (!std::ranges::equal(a.arcs_ending_at(n), b.arcs_ending_at(n))) return false;
  }
  for (Index i = 0; i < a.arc_count(); ++i)
    if (a.arc_end(i) != b.arc_end(i)) return false;
  return true;
}

}  // namespace

TEST_CASE("a height on the octahedron has two nodes and nothing between them") {
  const ScalarField field(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  const MorseSmaleComplex complex(field);
  complex.validate();
  CHECK(complex.node_count() == 2);
  CHECK(complex.arc_count() == 0);
  CHECK(complex.quad_count() == 0);
  CHECK(complex.node(0).kind == NodeKind::minimum);
  CHECK(complex.node(0).vertex == 1);
  CHECK(complex.node(0).value == -9);
  CHECK(complex.node(1).kind == NodeKind::maximum);
  CHECK(complex.node(1).vertex == 0);
  CHECK(complex.node(1).value == 9);
  CHECK(complex.arcs_ending_at(0).empty());
}

TEST_CASE("one triangle has a minimum and a cap") {
  const MorseSmaleComplex complex(ScalarField(single_triangle().mesh(), {2, 0, 1}));
  complex.validate();
  REQUIRE(complex.node_count() == 2);
  CHECK(complex.arc_count() == 0);
  CHECK(complex.node(0).vertex == 1);
  CHECK(complex.node(1).kind == NodeKind::cap);
  CHECK(complex.node(1).cell == 0);
  CHECK(complex.node(1).vertex == 0);
  CHECK(std::isinf(complex.node(1).value));
}

TEST_CASE("the complex around a monkey saddle") {
  const TriangleMesh mesh = bipyramid(6).mesh();
  const MorseSmaleComplex complex(ScalarField(mesh, {0, -9, 1, -1, 2, -2, 3, -3}));
  complex.validate();
  // One minimum at 1, saddles on the edges 0-5 and 0-3, maxima at 2, 4 and 6.
  REQUIRE(complex.node_count() == 6);
  CHECK(complex.saddle_count() == 2);
  CHECK(complex.arc_count() == 8);
  CHECK(complex.quad_count() == 4);
  CHECK(complex.node(1).vertex == 0);
  CHECK(complex.node(2).vertex == 0);
  const Index max2 = complex.maximum_node(0);
  const Index max4 = complex.maximum_node(1);
  const Index max6 = complex.maximum_node(2);
  CHECK(complex.node(max4).vertex == 4);
  const auto ascending_ends = [&](Index saddle) {
    std::vector<Index> ends = {complex.arc_end(4 * saddle + 1), complex.arc_end(4 * saddle + 3)};
    std::sort(ends.begin(), ends.end());
    return ends;
  };
  CHECK(ascending_ends(0) == std::vector<Index>{max4, max6});
  CHECK(ascending_ends(1) == std::vector<Index>{max2, max4});
  CHECK(complex.arcs_ending_at(0).size() == 4);
  CHECK(complex.arcs_ending_at(max2).size() == 1);
  CHECK(complex.arcs_ending_at(max4).size() == 2);
  // Both saddles go down along 0-7 on one side, and along their own edges on the other.
  std::vector<std::vector<Index>> ways;
  std::vector<Index> cells;
  for (const Index a : {0, 2, 4, 6}) {
    complex.trace_cells(a, cells);
    ways.push_back(cells);
  }
  std::sort(ways.begin(), ways.end());
  CHECK(ways == std::vector<std::vector<Index>>{{0, 3, 1}, {0, 5, 1}, {0, 7, 1}, {0, 7, 1}});
  // Round the minimum, seen from below, come 3, 5 and 7 clockwise about the axis: between the two arcs along
  // 7 nothing but the maximum between the saddles' other arcs.
  std::vector<Index> second;
  for (const Index a : complex.arcs_ending_at(0)) {
    complex.trace_cells(a, cells);
    second.push_back(cells[1]);
  }
  std::rotate(second.begin(), std::find(second.begin(), second.end(), Index{3}), second.end());
  CHECK(second == std::vector<Index>{3, 7, 7, 5});
}

TEST_CASE("a dome in a disc") {
  // Vertex 0 in the middle is a maximum; the rim rises from 1 to 6, so its end 6 is a saddle to the cap.
  const TriangleMesh mesh = wheel(6).mesh();
  const MorseSmaleComplex complex(ScalarField(mesh, {9, 1, 2, 3, 4, 5, 6}));
  complex.validate();
  REQUIRE(complex.node_count() == 4);
  CHECK(complex.node(0).vertex == 1);
  CHECK(complex.node(1).vertex == 6);
  CHECK(complex.node(2).vertex == 0);
  CHECK(complex.node(3).kind == NodeKind::cap);
  CHECK(mesh.edge_vertices(complex.node(1).cell) == std::array<Index, 2>{5, 6});
  // Edge 5-6 runs along the boundary: its inner triangle is on the left and leads to the maximum.
  CHECK(ends_of(complex, 0) == std::vector<Index>{0, 3, 0, 2});
  CHECK(complex.quad_count() == 2);
  std::vector<Point> points;
  complex.trace(1, points);
  REQUIRE(points.size() == 2);
  CHECK(is_at(points[0], mesh.position(6)));
  CHECK(is_at(points[1], (mesh.position(5) + mesh.position(6)) / 2));
  complex.trace(3, points);
  CHECK(is_at(points.front(), mesh.position(6)));
  CHECK(is_at(points.back(), mesh.position(0)));
  for (Index q = 0; q < 2; ++q) {
    const Quad quad = complex.quad(q);
    CHECK(quad.nodes[0] == 0);
    CHECK(quad.nodes[1] == 1);
    CHECK(quad.nodes[2] == (q == 0 ? 3 : 2));
    CHECK(quad.nodes[3] == 1);
  }
}

TEST_CASE("an annulus has an arc to each of its caps") {
  const MorseSmaleComplex complex(ScalarField(annulus(3, 2).mesh(), {0, 1, 2, 3, 4, 5}));
  complex.validate();
  REQUIRE(complex.node_count() == 4);
  CHECK(complex.saddle_count() == 1);
  CHECK(complex.cap_count() == 2);
  CHECK(complex.node(1).vertex == 2);
  std::vector<Index> ends = ends_of(complex, 0);
  std::sort(ends.begin(), ends.end());
  CHECK(ends == std::vector<Index>{0, 0, complex.cap_node(0), complex.cap_node(1)});
}

TEST_CASE("the complex keeps every invariant on every mesh and field") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {21u, 22u, 23u, 24u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        const MorseSmaleComplex complex(f.field);
        REQUIRE_NOTHROW(complex.validate());
        const morse::CriticalPoints points = morse::classify(f.field);
        CHECK(complex.minimum_count() == points.minima);
        CHECK(complex.saddle_count() == points.saddle_multiplicity);
        CHECK(complex.maximum_count() == points.maxima);
        CHECK(complex.cap_count() == entry.mesh.boundary_loop_count());
        CHECK(complex.arc_count() == 4 * points.saddle_multiplicity);
        CHECK(complex.quad_count() == 2 * points.saddle_multiplicity);
      }
}

TEST_CASE("the complex at vertices of degree ten thousand") {
  for (const TriangleMesh& mesh : {wheel(10000).mesh(), shuffled(bipyramid(10000), 2).mesh()})
    for (const unsigned seed : {1u, 2u})
      for (const NamedField& f : field_zoo(mesh, seed)) {
        INFO(mesh.vertex_count() << " vertices | " << f.name << " | seed " << seed);
        REQUIRE_NOTHROW(MorseSmaleComplex(f.field).validate());
      }
}

TEST_CASE("the complex of a saddle of multiplicity 4999") {
  // The upper pole is level with the middle of an equator that goes up and down five thousand times.
  std::vector<double> values = {0, -9};
  for (int i = 0; i < 10000; ++i) values.push_back((i % 2 == 0 ? 1 : -1) * (1 + i % 97 / 97.0));
  const MorseSmaleComplex complex(ScalarField(bipyramid(10000).mesh(), values));
  REQUIRE_NOTHROW(complex.validate());
  CHECK(complex.saddle_count() == 4999);
  CHECK(complex.maximum_count() == 5000);
  CHECK(complex.arcs_ending_at(0).size() == 2 * 4999);
}

TEST_CASE("the complex is the same for every number of threads") {
  const TriangleMesh mesh = punctured_sphere(5, 5).mesh();
  for (const NamedField& f : field_zoo(mesh, 51)) {
    INFO(f.name);
    const auto complex_with = [&](int threads) {
      core::ThreadLimit limit(threads);
      return MorseSmaleComplex(f.field);
    };
    const MorseSmaleComplex one = complex_with(1);
    CHECK(same_bits(one, complex_with(2)));
    CHECK(same_bits(one, complex_with(7)));
  }
}

TEST_CASE("a gradient on another mesh is refused") {
  const ScalarField field(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  const ScalarField other(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  CHECK_THROWS_AS(MorseSmaleComplex(field, mscomplex::DiscreteGradient(other)), core::InvalidArgument);
}
