#include "morsel/mscomplex/hierarchy.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/mscomplex/hierarchy_cursor.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/pairing.h"
#include "support/fields.h"
#include "support/greedy_hierarchy.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using core::ScalarField;
using mscomplex::Cancellation;
using mscomplex::DiscreteGradient;
using mscomplex::HierarchyCursor;
using mscomplex::MorseSmaleComplex;
using mscomplex::NodeKind;
using mscomplex::PersistenceHierarchy;
using mscomplex::Quad;

namespace {

/// The nodes of one level and what they are called in a complex that has no others.
struct Renumbering {
  Renumbering(const PersistenceHierarchy& hierarchy, Index level) {
    const MorseSmaleComplex& all = hierarchy.complex();
    Index next = 0;
    Index next_saddle = 0;
    for (Index n = 0; n < all.node_count(); ++n) {
      node.push_back(hierarchy.is_alive(n, level) ? next++ : kNone);
      if (all.kind(n) == NodeKind::saddle) saddle.push_back(node.back() != kNone ? next_saddle++ : kNone);
    }
    count = next;
  }
  Index arc(Index a) const { return 4 * saddle[a / 4] + a % 4; }
  std::vector<Index> node;
  std::vector<Index> saddle;
  Index count = 0;
};

/// The cursor's complex against the one that is traced in the gradient with its V-paths turned round.
void check_level(const ScalarField& field, const HierarchyCursor& cursor,
                 const PersistenceHierarchy& hierarchy) {
  cursor.validate();
  const Index level = cursor.level();
  DiscreteGradient gradient = hierarchy.gradient(level);
  gradient.validate();
  const MorseSmaleComplex& all = hierarchy.complex();
  const MorseSmaleComplex traced(field, std::move(gradient));
  traced.validate();
  REQUIRE(traced.minimum_count() == hierarchy.minimum_count(level));
  REQUIRE(traced.saddle_count() == hierarchy.saddle_count(level));
  REQUIRE(traced.maximum_count() == hierarchy.maximum_count(level));
  const Renumbering now(hierarchy, level);
  REQUIRE(traced.node_count() == now.count);
  for (Index n = 0; n < all.node_count(); ++n) {
    if (now.node[n] == kNone) continue;
    REQUIRE(traced.node(now.node[n]).cell == all.node(n).cell);
    REQUIRE(traced.kind(now.node[n]) == all.kind(n));
    if (all.kind(n) == NodeKind::saddle) continue;
    REQUIRE((cursor.arc_ending_at(n) == kNone) == traced.arcs_ending_at(now.node[n]).empty());
  }
  for (Index a = 0; a < all.arc_count(); ++a) {
    if (!cursor.is_arc_alive(a)) continue;
    REQUIRE(traced.arc_end(now.arc(a)) == now.node[cursor.arc_end(a)]);
    REQUIRE(traced.next_around_end(now.arc(a)) == now.arc(cursor.next_around_end(a)));
    if (a % 2 == 0) {
      const Quad quad = cursor.quad_left_of(a);
      const Quad expected = traced.quad(traced.quad_left_of(now.arc(a)));
      for (std::size_t i = 0; i < 4; ++i) {
        REQUIRE(now.node[quad.nodes[i]] == expected.nodes[i]);
        REQUIRE(now.arc(quad.arcs[i]) == expected.arcs[i]);
      }
    }
  }
}

/// The cancellations against the finite pairs of the diagram, in their order.
void check_pairs(const ScalarField& field, const PersistenceHierarchy& hierarchy) {
  const persistence::Diagram diagram = persistence::pair_extrema(field);
  const auto pairs = diagram.finite_pairs();
  REQUIRE(pairs.size() == hierarchy.levels());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Cancellation& c = hierarchy.cancellations()[i];
    const auto extremum = hierarchy.complex().node(c.extremum);
    REQUIRE(extremum.vertex == pairs[i].extremum);
    REQUIRE(hierarchy.complex().node(hierarchy.saddle_of(c)).vertex == pairs[i].saddle);
    REQUIRE(c.persistence == pairs[i].persistence());
    REQUIRE((extremum.kind == NodeKind::minimum) == (pairs[i].kind == persistence::PairKind::minimum_saddle));
  }
}

/// Some levels, the first and the last among them, not in order.
std::vector<Index> some_levels(Index last, unsigned seed) {
  std::vector<Index> levels = {last, 0};
  std::mt19937 random(seed);
  for (int i = 0; i < 6; ++i) levels.push_back(static_cast<Index>(random() % (last + 1)));
  return levels;
}

void check_hierarchy(const ScalarField& field, unsigned seed) {
  const PersistenceHierarchy hierarchy(field);
  hierarchy.validate();
  check_pairs(field, hierarchy);
  HierarchyCursor cursor(hierarchy);
  for (const Index level : some_levels(hierarchy.levels(), seed)) {
    INFO("level " << level);
    cursor.go_to(level);
    REQUIRE(cursor.level() == level);
    check_level(field, cursor, hierarchy);
  }
}

std::set<Index> extrema_of(const MorseSmaleComplex& complex) {
  std::set<Index> vertices;
  for (Index n = 0; n < complex.node_count(); ++n)
    if (complex.kind(n) == NodeKind::minimum || complex.kind(n) == NodeKind::maximum)
      vertices.insert(complex.node(n).vertex);
  return vertices;
}

/// A level against the complex of the field in which the same pairs are cancelled.
void check_against_cancelled(const ScalarField& field, const PersistenceHierarchy& hierarchy, Index level) {
  if (level == 0 || level == hierarchy.levels()) return;
  const double threshold = hierarchy.cancellations()[level - 1].persistence;
  if (hierarchy.cancellations()[level].persistence == threshold) return;
  const auto cancelled = persistence::cancel(field, {persistence::Threshold::absolute(threshold), {}});
  REQUIRE(cancelled.cancelled_pairs == level);
  const MorseSmaleComplex fresh(cancelled.field);
  const MorseSmaleComplex kept(field, hierarchy.gradient(level));
  REQUIRE(fresh.minimum_count() == kept.minimum_count());
  REQUIRE(fresh.maximum_count() == kept.maximum_count());
  REQUIRE(fresh.saddle_count() == kept.saddle_count());
  REQUIRE(fresh.arc_count() == kept.arc_count());
  REQUIRE(fresh.quad_count() == kept.quad_count());
  REQUIRE(extrema_of(fresh) == extrema_of(kept));
}

/// Share of the vertices that lie in the basin of the same minimum, and of the triangles on the hill of the
/// same maximum or cap, at a level and in the field with the same pairs cancelled. Near saddles that flooding
/// moves they may differ.
std::array<double, 2> agreement(const ScalarField& field, const PersistenceHierarchy& hierarchy,
                                Index level) {
  const double threshold = hierarchy.cancellations()[level - 1].persistence;
  const ScalarField cancelled =
      persistence::cancel(field, {persistence::Threshold::absolute(threshold), {}}).field;
  const DiscreteGradient kept = hierarchy.gradient(level);
  const DiscreteGradient fresh(cancelled);
  const auto a = mscomplex::segment(field, kept);
  const auto b = mscomplex::segment(cancelled, fresh);
  const auto top = [](const DiscreteGradient& gradient, Index label) {
    const auto maxima = gradient.maxima();
    return label < maxima.size() ? long{maxima[label].vertex} : -1 - static_cast<long>(label - maxima.size());
  };
  Index vertices = 0;
  for (Index v = 0; v < field.mesh().vertex_count(); ++v)
    if (kept.minima()[a.ascending.vertex[v]] == fresh.minima()[b.ascending.vertex[v]]) ++vertices;
  Index triangles = 0;
  for (Index t = 0; t < field.mesh().triangle_count(); ++t)
    if (top(kept, a.descending.triangle[t]) == top(fresh, b.descending.triangle[t])) ++triangles;
  return {1.0 * vertices / field.mesh().vertex_count(), 1.0 * triangles / field.mesh().triangle_count()};
}

ScalarField curvature_of(const std::string& file) {
  return morse::mean_curvature(core::read_mesh(sample(file)).mesh);
}

}  // namespace

TEST_CASE("two minima merge and their saddle is cancelled") {
  // Around the equator 2, 3, 4, 5: low, high, low, high; vertex 0 is the saddle, vertex 1 the maximum.
  const ScalarField field(octahedron().mesh(), {0, 9, -3, 5, -2, 4});
  const PersistenceHierarchy hierarchy(field);
  hierarchy.validate();
  REQUIRE(hierarchy.levels() == 1);
  const Cancellation c = hierarchy.cancellations()[0];
  const MorseSmaleComplex& complex = hierarchy.complex();
  CHECK(complex.node(c.extremum).vertex == 4);
  CHECK(complex.node(c.survivor).vertex == 2);
  CHECK(complex.node(hierarchy.saddle_of(c)).vertex == 0);
  CHECK(c.persistence == 2);
  CHECK(hierarchy.survivor(c.extremum, 0) == c.extremum);
  CHECK(hierarchy.survivor(c.extremum, 1) == c.survivor);
  CHECK(hierarchy.is_alive(c.extremum, 0));
  CHECK_FALSE(hierarchy.is_alive(c.extremum, 1));
  CHECK_FALSE(hierarchy.is_alive(hierarchy.saddle_of(c), 1));
  CHECK(hierarchy.last_level(c.survivor) == kNone);
  CHECK(hierarchy.minimum_count(0) == 2);
  CHECK(hierarchy.minimum_count(1) == 1);
  CHECK(hierarchy.maximum_count(1) == 1);
  CHECK(hierarchy.saddle_count(1) == 0);

  HierarchyCursor cursor(hierarchy);
  cursor.go_to(1);
  cursor.validate();
  CHECK(cursor.arc_ending_at(c.survivor) == kNone);
  cursor.go_to(0);
  cursor.validate();
  CHECK(cursor.arc_ending_at(c.survivor) != kNone);

  // The V-path from the saddle to vertex 4 is turned round: from there it leads to vertex 2.
  const DiscreteGradient gradient = hierarchy.gradient(1);
  gradient.validate();
  CHECK(std::ranges::equal(gradient.minima(), std::vector<Index>{2}));
  CHECK(gradient.descend(4) == 0);
  CHECK(gradient.descend(0) == 2);
}

TEST_CASE("a monkey saddle is cancelled one maximum at a time") {
  const ScalarField field(bipyramid(6).mesh(), {0, -9, 1, -1, 2, -2, 3, -3});
  const PersistenceHierarchy hierarchy(field);
  hierarchy.validate();
  REQUIRE(hierarchy.levels() == 2);
  CHECK(hierarchy.complex().node(hierarchy.cancellations()[0].extremum).vertex == 2);
  CHECK(hierarchy.cancellations()[0].persistence == 1);
  CHECK(hierarchy.complex().node(hierarchy.cancellations()[1].extremum).vertex == 4);
  CHECK(hierarchy.cancellations()[1].persistence == 2);
  CHECK(hierarchy.level_above(0.5) == 0);
  CHECK(hierarchy.level_above(1) == 1);
  CHECK(hierarchy.level_above(100) == 2);
  CHECK(hierarchy.level_with(6) == 0);  // a minimum, a double saddle, three maxima
  CHECK(hierarchy.level_with(5) == 1);
  CHECK(hierarchy.level_with(4) == 1);
  CHECK(hierarchy.level_with(3) == 2);
  CHECK(hierarchy.level_with(0) == 2);
  CHECK(hierarchy.level_with_maxima(3) == 0);
  CHECK(hierarchy.level_with_maxima(2) == 1);
  CHECK(hierarchy.level_with_maxima(0) == 2);
  CHECK(hierarchy.level_with_minima(1) == 0);
  CHECK(hierarchy.level_with_minima(0) == 2);
}

TEST_CASE("every level of a hierarchy is the complex of the gradient with V-paths turned round") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {81u, 82u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        check_hierarchy(f.field, seed);
      }
}

TEST_CASE("cancellations are those of repeatedly cancelling the shortest arc") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    const PersistenceHierarchy hierarchy({mesh, random_values(mesh.vertex_count(), seed)});
    const auto greedy = cancel_greedily(hierarchy.complex());
    REQUIRE(greedy.size() == hierarchy.levels());
    std::set<std::array<Index, 2>> saddles_and_extrema;
    std::set<std::array<Index, 2>>
        expected;  // the saddle's vertex: a multiple saddle may give either of its cells
    for (std::size_t i = 0; i < greedy.size(); ++i) {
      const Cancellation& c = hierarchy.cancellations()[i];
      REQUIRE(c.persistence == greedy[i].persistence);
      saddles_and_extrema.insert({hierarchy.complex().node(hierarchy.saddle_of(c)).vertex, c.extremum});
      expected.insert({hierarchy.complex().node(greedy[i].saddle).vertex, greedy[i].extremum});
    }
    REQUIRE(saddles_and_extrema == expected);
  }
}

TEST_CASE("hierarchies of random surfaces") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    check_hierarchy({mesh, random_values(mesh.vertex_count(), seed)}, seed);
    check_hierarchy({mesh, tied_values(mesh.vertex_count(), 3, seed)}, seed);
  }
}

TEST_CASE("a level has the extrema and the counts of the field with the same pairs cancelled") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 83)) {
      INFO(entry.name << " | " << f.name);
      const PersistenceHierarchy hierarchy(f.field);
      for (const Index level : some_levels(hierarchy.levels(), 83))
        check_against_cancelled(f.field, hierarchy, level);
    }
}

TEST_CASE("segments of a level are those of the complex, merged") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 84)) {
      INFO(entry.name << " | " << f.name);
      const PersistenceHierarchy hierarchy(f.field);
      const MorseSmaleComplex& complex = hierarchy.complex();
      const auto finest = mscomplex::segment(f.field, complex.gradient());
      for (const Index level : some_levels(hierarchy.levels(), 84)) {
        const DiscreteGradient gradient = hierarchy.gradient(level);
        const auto merged = mscomplex::segment(f.field, gradient);
        const Renumbering now(hierarchy, level);
        const Index first_top = hierarchy.minimum_count(level) + hierarchy.saddle_count(level);
        for (Index v = 0; v < entry.mesh.vertex_count(); ++v) {
          const Index minimum = hierarchy.survivor(finest.ascending.vertex[v], level);
          REQUIRE(now.node[minimum] == merged.ascending.vertex[v]);
          const Index top = hierarchy.survivor(complex.maximum_node(finest.descending.vertex[v]), level);
          REQUIRE(now.node[top] - first_top == merged.descending.vertex[v]);
        }
        for (Index t = 0; t < entry.mesh.triangle_count(); ++t) {
          const Index minimum = hierarchy.survivor(finest.ascending.triangle[t], level);
          REQUIRE(now.node[minimum] == merged.ascending.triangle[t]);
          const Index top = hierarchy.survivor(complex.maximum_node(finest.descending.triangle[t]), level);
          REQUIRE(now.node[top] - first_top == merged.descending.triangle[t]);
        }
      }
    }
}

TEST_CASE("hierarchies of real meshes") {
  struct Expected {
    std::string file;
    Index pairs;
    std::array<Index, 3> above;  // 0.1, 1 and 5 % of the extent
  };
  for (const Expected& expected :
       {Expected{"lion-head.off", 960, {734, 295, 98}}, Expected{"bunny00.off", 4099, {3508, 1369, 263}}}) {
    INFO(expected.file);
    const ScalarField field = curvature_of(expected.file);
    const PersistenceHierarchy hierarchy(field);
    check_pairs(field, hierarchy);
    const auto caps = field.mesh().boundary_loop_count();
    CHECK(hierarchy.levels() == expected.pairs);
    HierarchyCursor cursor(hierarchy);
    for (std::size_t i = 0; i < 3; ++i) {
      const Index level = hierarchy.level_above(std::array{0.001, 0.01, 0.05}[i] * field.extent());
      CHECK(hierarchy.levels() - level == expected.above[i]);
      cursor.go_to(level);
      check_level(field, cursor, hierarchy);
      check_against_cancelled(field, hierarchy, level);
      for (const double share : agreement(field, hierarchy, level))
        CHECK(share > 0.95);  // 0.958 to 0.999 seen
    }
    cursor.go_to(hierarchy.levels());
    check_level(field, cursor, hierarchy);
    CHECK(hierarchy.minimum_count(hierarchy.levels()) == 1);
    CHECK(hierarchy.maximum_count(hierarchy.levels()) == 1 - caps);
    cursor.go_to(0);
    check_level(field, cursor, hierarchy);
  }
}

TEST_CASE("a hierarchy of a surface with handles ends with two saddles a handle") {
  const ScalarField field = curvature_of("refined_elephant.off");
  const PersistenceHierarchy hierarchy(field);
  check_pairs(field, hierarchy);
  HierarchyCursor cursor(hierarchy);
  cursor.go_to(hierarchy.levels());
  check_level(field, cursor, hierarchy);
  CHECK(hierarchy.saddle_count(hierarchy.levels()) == 6);
  CHECK(hierarchy.minimum_count(hierarchy.levels()) == 1);
  CHECK(hierarchy.maximum_count(hierarchy.levels()) == 1);
}

TEST_CASE("a cursor has the same state from either direction") {
  const TriangleMesh mesh = punctured_sphere(4, 3).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 85));
  const PersistenceHierarchy hierarchy(field);
  HierarchyCursor up(hierarchy);
  HierarchyCursor down(hierarchy);
  down.go_to(hierarchy.levels());
  const Index middle = hierarchy.levels() / 2;
  up.go_to(middle);
  down.go_to(middle);
  for (Index a = 0; a < hierarchy.complex().arc_count(); ++a) {
    if (!up.is_arc_alive(a)) continue;
    REQUIRE(up.next_around_end(a) == down.next_around_end(a));
    REQUIRE(up.previous_around_end(a) == down.previous_around_end(a));
  }
}

TEST_CASE("a hierarchy is the same for every number of threads") {
  const TriangleMesh mesh = torus(60, 40).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 86));
  const auto arcs_with = [&](int threads) {
    core::ThreadLimit limit(threads);
    std::vector<Index> arcs;
    const PersistenceHierarchy hierarchy(field);
    for (const Cancellation& c : hierarchy.cancellations()) arcs.push_back(c.arc);
    return arcs;
  };
  const std::vector<Index> one = arcs_with(1);
  CHECK(one.size() > 500);
  CHECK(arcs_with(2) == one);
  CHECK(arcs_with(7) == one);
}

TEST_CASE("invalid cancellations and levels are refused") {
  const ScalarField field(octahedron().mesh(), {0, 9, -3, 5, -2, 4});
  const ScalarField other(octahedron().mesh(), {0, 9, -3, 5, -2, 4});
  CHECK_THROWS_AS(PersistenceHierarchy(field, MorseSmaleComplex(other)), core::InvalidArgument);
  const PersistenceHierarchy hierarchy(field);
  HierarchyCursor cursor(hierarchy);
  CHECK_THROWS_AS(cursor.go_to(2), core::InvalidArgument);

  const DiscreteGradient& gradient = hierarchy.complex().gradient();
  const auto reversed = [&](std::vector<Index> arcs) { return gradient.with_reversed(arcs); };
  CHECK_THROWS_WITH(reversed({4}), Catch::Contains("no such saddle"));
  CHECK_THROWS_WITH(reversed({0, 2}), Catch::Contains("cancelled already"));
  CHECK_THROWS_WITH(reversed({1}), Catch::Contains("same maximum"));  // both ways up lead to vertex 1
  CHECK_THROWS_WITH(reversed({3}), Catch::Contains("same maximum"));
  const ScalarField upside_down(octahedron().mesh(), {0, -9, 3, -5, 2, -4});
  CHECK_THROWS_WITH(DiscreteGradient(upside_down).with_reversed(std::vector<Index>{0}),
                    Catch::Contains("same minimum"));
  const ScalarField bounded(grid(3, 2).mesh(), {0, 3, 1, 0.5, 4, 1.5});
  const DiscreteGradient with_cap(bounded);
  REQUIRE(with_cap.saddles().size() == 1);
  CHECK_THROWS_WITH(with_cap.with_reversed(std::vector<Index>{1}), Catch::Contains("cap"));
}
