#include "morsel/mscomplex/discrete_gradient.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "support/fields.h"
#include "support/lower_star_oracle.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using core::ScalarField;
using morse::CriticalPoint;
using morse::CriticalType;
using mscomplex::CriticalCell;
using mscomplex::DiscreteGradient;

namespace {

/// The gradient in the oracle's terms.
GradientOracle in_words(const DiscreteGradient& gradient) {
  const TriangleMesh& mesh = gradient.mesh();
  GradientOracle words;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    if (gradient.paired_vertex(e) != kNone) words.pairs[{gradient.paired_vertex(e)}] = edge_cell(mesh, e);
    if (gradient.paired_triangle(e) != kNone)
      words.pairs[edge_cell(mesh, e)] = triangle_cell(mesh, gradient.paired_triangle(e));
  }
  // The oracle goes vertex by vertex, and so do the lists.
  auto saddle = gradient.saddles().begin();
  auto minimum = gradient.minima().begin();
  auto maximum = gradient.maxima().begin();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (minimum != gradient.minima().end() && *minimum == v) words.critical.push_back({*minimum++});
    for (; saddle != gradient.saddles().end() && saddle->vertex == v; ++saddle)
      words.critical.push_back(edge_cell(mesh, saddle->cell));
    for (; maximum != gradient.maxima().end() && maximum->vertex == v; ++maximum)
      words.critical.push_back(triangle_cell(mesh, maximum->cell));
  }
  return words;
}

/// Invariant 2: the critical cells are the classified critical points, vertex by vertex.
void check_against_classification(const ScalarField& field, const DiscreteGradient& gradient) {
  std::vector<CriticalPoint> found;
  for (const Index v : gradient.minima()) found.push_back({v, CriticalType::minimum, 1});
  for (const CriticalCell& m : gradient.maxima()) found.push_back({m.vertex, CriticalType::maximum, 1});
  for (const CriticalCell& s : gradient.saddles()) {
    if (!found.empty() && found.back().vertex == s.vertex)
      ++found.back().multiplicity;
    else
      found.push_back({s.vertex, CriticalType::saddle, 1});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  CHECK(found == morse::classify(field).points);
}

}  // namespace

TEST_CASE("the gradient of the height on the octahedron") {
  // Top 0, bottom 1, equator 2 to 5 rising.
  const TriangleMesh mesh = octahedron().mesh();
  const ScalarField field(mesh, {9, -9, 1, 2, 3, 4});
  const DiscreteGradient gradient(field);
  gradient.validate(field);
  REQUIRE(gradient.minima().size() == 1);
  CHECK(gradient.minima()[0] == 1);
  CHECK(gradient.saddles().empty());
  REQUIRE(gradient.maxima().size() == 1);
  CHECK(triangle_cell(mesh, gradient.maxima()[0].cell) == Cell{0, 4, 5});
  CHECK(gradient.maxima()[0].vertex == 0);
  CHECK(gradient.descend(0) == 2);
  for (Index v = 2; v < 6; ++v) CHECK(gradient.descend(v) == 1);
  CHECK(gradient.descend(1) == kNone);
  CHECK(gradient.ascend(gradient.maxima()[0].cell) == kNone);
}

TEST_CASE("the gradient at a monkey saddle has two critical edges at one vertex") {
  const TriangleMesh mesh = bipyramid(6).mesh();
  const ScalarField field(mesh, {0, -9, 1, -1, 2, -2, 3, -3});
  const DiscreteGradient gradient(field);
  gradient.validate(field);
  REQUIRE(gradient.saddles().size() == 2);
  // Lower runs {7}, {5}, {3}: vertex 0 is paired towards the lowest, 7; the others follow by rank.
  CHECK(gradient.descend(0) == 7);
  CHECK(edge_cell(mesh, gradient.saddles()[0].cell) == Cell{0, 5});
  CHECK(edge_cell(mesh, gradient.saddles()[1].cell) == Cell{0, 3});
  CHECK(gradient.maxima().size() == 3);
}

TEST_CASE("the gradient on one triangle flows into the cap") {
  const ScalarField field(single_triangle().mesh(), {0, 1, 2});
  const DiscreteGradient gradient(field);
  gradient.validate(field);
  CHECK(gradient.minima().size() == 1);
  CHECK(gradient.saddles().empty());
  CHECK(gradient.maxima().empty());
  CHECK(gradient.mesh().edge_vertices(gradient.mesh().edge(gradient.paired_halfedge(0))) ==
        std::array<Index, 2>{1, 2});
  CHECK(gradient.ascend(0) == kNone);
}

TEST_CASE("the gradient is that of ProcessLowerStars") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {1u, 2u, 3u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        const DiscreteGradient gradient(f.field);
        const GradientOracle oracle = process_lower_stars(f.field);
        const GradientOracle words = in_words(gradient);
        REQUIRE(words.pairs == oracle.pairs);
        REQUIRE(words.critical == oracle.critical);
      }
}

TEST_CASE("the gradient is that of ProcessLowerStars around one large lower star") {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u})
    for (const double top : {-1.0, 0.5, 0.9, 2.0}) {
      INFO("seed " << seed << " | top " << top);
      const TriangleMesh mesh = shuffled(bipyramid(60), seed).mesh();
      std::vector<double> values = random_values(mesh.vertex_count(), seed);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.position(v).z() > 0.5) values[v] = top;
      const ScalarField field(mesh, values);
      const DiscreteGradient gradient(field);
      const GradientOracle oracle = process_lower_stars(field);
      CHECK(in_words(gradient).pairs == oracle.pairs);
      CHECK(in_words(gradient).critical == oracle.critical);
    }
}

TEST_CASE("the gradient keeps the rules and agrees with the classification") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {11u, 12u, 13u, 14u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        const DiscreteGradient gradient(f.field);
        REQUIRE_NOTHROW(gradient.validate(f.field));
        check_against_classification(f.field, gradient);
      }
}

TEST_CASE("the gradient at vertices of degree ten thousand") {
  for (const TriangleMesh& mesh : {wheel(10000).mesh(), bipyramid(10000).mesh()})
    for (const unsigned seed : {1u, 2u})
      for (const NamedField& f : field_zoo(mesh, seed)) {
        INFO(mesh.vertex_count() << " vertices | " << f.name << " | seed " << seed);
        const DiscreteGradient gradient(f.field);
        REQUIRE_NOTHROW(gradient.validate(f.field));
        check_against_classification(f.field, gradient);
      }
}

TEST_CASE("the gradient is the same for every number of threads") {
  const TriangleMesh mesh = torus(150, 120).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 5));
  const auto gradient_with = [&](int threads) {
    core::ThreadLimit limit(threads);
    return DiscreteGradient(field);
  };
  const DiscreteGradient one = gradient_with(1);
  for (const int threads : {2, 7}) {
    const DiscreteGradient many = gradient_with(threads);
    CHECK(std::ranges::equal(one.minima(), many.minima()));
    CHECK(std::ranges::equal(one.saddles(), many.saddles()));
    CHECK(std::ranges::equal(one.maxima(), many.maxima()));
    CHECK(std::ranges::equal(one.descents(), many.descents()));
    for (Index t = 0; t < mesh.triangle_count(); ++t)
      REQUIRE(one.paired_halfedge(t) == many.paired_halfedge(t));
  }
}

TEST_CASE("the gradient can be stopped") {
  std::stop_source source;
  source.request_stop();
  const ScalarField field(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  CHECK_THROWS_AS(DiscreteGradient(field, core::Progress({}, source.get_token())), core::Cancelled);
}
