#include "morsel/persistence/pairing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "checks.h"
#include "morsel/core/parallel/parallel.h"
#include "support/fields.h"
#include "support/mean_curvature.h"
#include "support/meshes.h"
#include "support/phat_oracle.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using persistence::Diagram;
using persistence::pair_extrema;
using persistence::PairKind;
using persistence::PersistencePair;

TEST_CASE("a field with one minimum and one maximum has essential classes only") {
  const Diagram diagram = pair_extrema({octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3}});
  CHECK(diagram.pairs.empty());
  CHECK(diagram.essential_saddles.empty());
  REQUIRE(diagram.essential_extrema.size() == 1);
  CHECK(diagram.essential_extrema[0] == persistence::EssentialExtrema{1, 0, false});
  CHECK(diagram.largest() == 0);
  CHECK(diagram.count_above(0) == 0);
}

TEST_CASE("the elder rule at a saddle with two minima and two maxima") {
  // Around the equator 2, 3, 4, 5: low, high, low, high; vertex 0 is the saddle, vertex 1 the minimum.
  const Diagram diagram = pair_extrema({octahedron().mesh(), {0, -9, -3, 5, -2, 4}});
  // Both lower runs of vertex 0 are connected below it through vertex 1.
  REQUIRE(diagram.pairs.size() == 1);
  CHECK(diagram.pairs[0] == PersistencePair{5, 0, PairKind::saddle_maximum, 0, 4});
  CHECK(diagram.essential_extrema[0] == persistence::EssentialExtrema{1, 3, false});

  const Diagram upside_down = pair_extrema({octahedron().mesh(), {0, 9, -3, 5, -2, 4}});
  REQUIRE(upside_down.pairs.size() == 1);
  CHECK(upside_down.pairs[0] == PersistencePair{4, 0, PairKind::minimum_saddle, -2, 0});
  CHECK(upside_down.pairs[0].persistence() == 2);
  CHECK(upside_down.essential_extrema[0] == persistence::EssentialExtrema{2, 1, false});
}

TEST_CASE("a monkey saddle is in two pairs and the larger counts for it") {
  const ScalarField field(bipyramid(6).mesh(), {0, -9, 1, -1, 2, -2, 3, -3});
  const Diagram diagram = pair_extrema(field);
  REQUIRE(diagram.pairs.size() == 2);
  CHECK(diagram.pairs[0] == PersistencePair{2, 0, PairKind::saddle_maximum, 0, 1});
  CHECK(diagram.pairs[1] == PersistencePair{4, 0, PairKind::saddle_maximum, 0, 2});
  CHECK(diagram.essential_extrema[0] == persistence::EssentialExtrema{1, 6, false});
  CHECK(diagram.largest() == 2);
  CHECK(diagram.count_above(1) == 1);
  const auto persistence = persistence::vertex_persistence(diagram, 8);
  CHECK(persistence == std::vector<double>{2, persistence::kInfinite, 1, 0, 2, 0, persistence::kInfinite, 0});
}

TEST_CASE("the caps of an annulus: the later loop is essential and the other pairs with a saddle") {
  const TriangleMesh mesh = annulus(6, 3).mesh();
  std::vector<double> values(mesh.vertex_count());
  for (Index v = 0; v < values.size(); ++v) values[v] = v;
  const ScalarField field(mesh, values);
  const Diagram diagram = pair_extrema(field);
  CHECK(diagram.essential_extrema[0] == persistence::EssentialExtrema{0, 1, true});
  CHECK(diagram.finite_count == 0);
  REQUIRE(diagram.cap_pairs().size() == 1);
  CHECK(diagram.cap_pairs()[0].extremum == 0);
  CHECK(diagram.cap_pairs()[0].kind == PairKind::saddle_cap);
  CHECK(std::isinf(diagram.cap_pairs()[0].persistence()));
}

TEST_CASE("on a bounded component the highest vertex is not essential") {
  const Diagram diagram = pair_extrema({wheel(6).mesh(), {9, 1, 2, 3, 4, 5, 6}});
  REQUIRE(diagram.pairs.size() == 1);
  CHECK(diagram.pairs[0] == PersistencePair{0, 6, PairKind::saddle_maximum, 6, 9});
  CHECK(diagram.essential_extrema[0] == persistence::EssentialExtrema{1, 0, true});
}

TEST_CASE("pairs are ordered by persistence and then in the order of the sweeps") {
  // Two valleys beside a deeper one, and two peaks below a higher one, all of persistence 1.
  const Diagram diagram = pair_extrema({bipyramid(6).mesh(), {0, 9, -1, 3, -1, 2, -5, 1}});
  REQUIRE(diagram.pairs.size() == 2);
  CHECK(diagram.pairs[0].extremum == 4);  // the younger by its number
  CHECK(diagram.pairs[1].extremum == 2);
}

TEST_CASE("pairs and essential classes are those of PHAT for every field on every mesh") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {1U, 20U, 300U})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << ", " << f.name << ", seed " << seed);
        const Diagram diagram = pair_extrema(f.field);
        CHECK(oracle_contradiction(f.field, diagram).empty());
        CHECK(diagram_contradiction(f.field, diagram).empty());
      }
}

TEST_CASE("pairs are those of PHAT on random surfaces") {
  for (unsigned seed = 0; seed < 400; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    for (const NamedField& f : field_zoo(mesh, seed)) {
      const Diagram diagram = pair_extrema(f.field);
      std::string wrong = oracle_contradiction(f.field, diagram);
      if (wrong.empty()) wrong = diagram_contradiction(f.field, diagram);
      INFO("seed " << seed << ", " << f.name << ": " << wrong);
      REQUIRE(wrong.empty());
    }
  }
}

TEST_CASE("pairs with an explicit order follow it") {
  const TriangleMesh mesh = sphere(1).mesh();
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ScalarField other(mesh, random_values(mesh.vertex_count(), seed));
    const ScalarField flat(mesh, std::vector<double>(mesh.vertex_count(), 2),
                           core::FlatArray<Index>(other.ranks().begin(), other.ranks().end()));
    CHECK(oracle_contradiction(flat, pair_extrema(flat)).empty());
    CHECK(pair_extrema(flat).largest() == 0);
    CHECK(pair_extrema(flat).finite_count == pair_extrema(other).finite_count);
  }
}

TEST_CASE("vertices of degree 10 thousand are paired") {
  const TriangleMesh mesh = bipyramid(10000).mesh();
  for (const NamedField& f : field_zoo(mesh, 5)) {
    INFO(f.name);
    CHECK(diagram_contradiction(f.field, pair_extrema(f.field)).empty());
  }
  std::vector<double> values(mesh.vertex_count());
  for (Index v = 2; v < values.size(); ++v) values[v] = v % 2 == 0 ? v : -static_cast<double>(v);
  values[1] = -20000;
  const Diagram diagram = pair_extrema({mesh, values});
  CHECK(diagram.finite_count == 4999);
  CHECK(diagram.pairs.front() == PersistencePair{2, 0, PairKind::saddle_maximum, 0, 2});
}

TEST_CASE("negating a field on a closed mesh mirrors its diagram") {
  for (const NamedMesh& entry : mesh_zoo()) {
    if (!entry.mesh.is_closed()) continue;
    const ScalarField field(entry.mesh, random_values(entry.mesh.vertex_count(), 3));
    const Diagram diagram = pair_extrema(field);
    const Diagram mirrored = pair_extrema(field.negated());
    INFO(entry.name);
    REQUIRE(mirrored.pairs.size() == diagram.pairs.size());
    for (std::size_t i = 0; i < diagram.pairs.size(); ++i) {
      CHECK(mirrored.pairs[i].extremum == diagram.pairs[i].extremum);
      CHECK(mirrored.pairs[i].saddle == diagram.pairs[i].saddle);
      CHECK(mirrored.pairs[i].kind != diagram.pairs[i].kind);
    }
    CHECK(mirrored.essential_saddles == diagram.essential_saddles);
  }
}

TEST_CASE("any number of threads gives the same diagram") {
  const TriangleMesh mesh = sphere(5).mesh();
  const ScalarField field(mesh, tied_values(mesh.vertex_count(), 1000, 8));
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return pair_extrema(field);
  };
  const Diagram one = run(1);
  for (const int threads : {2, 4, 7}) {
    const Diagram many = run(threads);
    CHECK(many.pairs == one.pairs);
    CHECK(many.essential_extrema == one.essential_extrema);
    CHECK(many.essential_saddles == one.essential_saddles);
  }
}

TEST_CASE("pairing reports its progress and can be stopped") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 1));
  std::stop_source stop;
  double last = -1;
  pair_extrema(field, core::Progress([&](std::string_view, double fraction) { last = fraction; }));
  CHECK(last == 1);
  stop.request_stop();
  CHECK_THROWS_AS(pair_extrema(field, core::Progress({}, stop.get_token())), core::Cancelled);
}

TEST_CASE("reference counts of pairs of mean curvature on real meshes") {
  struct Reference {
    const char* file;
    std::size_t pairs, above_01, above_1, above_5;
  };
  for (const Reference& reference :
       {Reference{"lion-head.off", 960, 734, 295, 98}, Reference{"bunny00.off", 4099, 3508, 1369, 263}}) {
    const TriangleMesh mesh = read_plain_off(sample(reference.file));
    const ScalarField field(mesh, plain_mean_curvature(mesh));
    const Diagram diagram = pair_extrema(field);
    INFO(reference.file);
    CHECK(diagram.finite_count == reference.pairs);
    CHECK(diagram.count_above(0.001 * field.extent()) == reference.above_01);
    CHECK(diagram.count_above(0.01 * field.extent()) == reference.above_1);
    CHECK(diagram.count_above(0.05 * field.extent()) == reference.above_5);
    CHECK(diagram_contradiction(field, diagram).empty());
  }
}

TEST_CASE("pairs are those of PHAT for mean curvature on the lion head") {
  const TriangleMesh mesh = read_plain_off(sample("lion-head.off"));
  const ScalarField field(mesh, plain_mean_curvature(mesh));
  CHECK(oracle_contradiction(field, pair_extrema(field)).empty());
}
