#include "morsel/morse/chosen_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/diffused_curvature.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/persistence/pairing.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/path_oracle.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::choose_points;
using morse::ChosenPoints;
using morse::CriticalType;
using morse::point_candidates;
using morse::PointCandidate;
using morse::PointKind;

namespace {

constexpr std::array kKinds = {PointKind::extrema, PointKind::maxima, PointKind::minima, PointKind::saddles,
                               PointKind::all};
using Candidates = std::vector<std::vector<PointCandidate>>;

std::vector<Index> vertices_of(const std::vector<PointCandidate>& candidates) {
  std::vector<Index> result;
  for (const PointCandidate& one : candidates) result.push_back(one.point.vertex);
  return result;
}
std::vector<Index> vertices_of(const ChosenPoints& chosen) {
  std::vector<Index> result;
  for (const auto& one : chosen.points) result.push_back(one.candidate.point.vertex);
  return result;
}

/// A strip of squares with a value for each of its columns: 0, 1, 2 … above the x axis, the rest below.
ScalarField ridge(const std::vector<double>& heights) {
  const auto columns = static_cast<int>(heights.size());
  std::vector<double> values;
  for (int y = 0; y < 3; ++y)
    for (const double h : heights) values.push_back(y == 1 ? h : 0.01 * h);
  return {grid(columns, 3).mesh(), values};
}

}  // namespace

TEST_CASE("candidates come by persistence, essential ones with their component's extent") {
  // Inner peaks of heights 5 and 3 with a saddle of 1 between them, on a strip.
  const ScalarField field = ridge({0, 2, 5, 2, 1, 2, 3, 2, 0});
  const std::vector<PointCandidate> maxima = point_candidates(field, PointKind::maxima);
  REQUIRE(maxima.size() == 2);
  CHECK(vertices_of(maxima) == std::vector<Index>{11, 15});
  CHECK(maxima[1].persistence == 2);  // it ends at the saddle between them
  CHECK(maxima[1].rank == 2);
  CHECK(maxima[0].value == 5);
  const std::vector<PointCandidate> octahedral =
      point_candidates(ScalarField(octahedron().mesh(), {1, 0, 0.5, 0.6, 0.5, 0.6}), PointKind::extrema);
  // Of equal rank the maximum comes first.
  CHECK(vertices_of(octahedral) == std::vector<Index>{0, 1});
  CHECK(octahedral[0].rank == 1);
  CHECK(std::isinf(octahedral[0].persistence));
}

TEST_CASE("a weight multiplies the rank, and what has none is no candidate") {
  const ScalarField field = ridge({0, 2, 5, 2, 1, 2, 3, 2, 0});
  std::vector<double> weight(field.values().size(), 1);
  weight[15] = 100;
  CHECK(vertices_of(point_candidates(field, PointKind::maxima, weight)) == std::vector<Index>{15, 11});
  weight[15] = 0;
  CHECK(vertices_of(point_candidates(field, PointKind::maxima, weight)) == std::vector<Index>{11});
  for (const PointKind kind : kKinds)
    CHECK(point_candidates(ScalarField(sphere(2).mesh(), std::vector<double>(162, 3.0)), kind).empty());
  CHECK_THROWS_AS(point_candidates(field, PointKind::all, std::vector<double>(3, 1.0)),
                  core::InvalidArgument);
}

TEST_CASE("points are taken by rank where they are not too near, as many as wanted") {
  const ScalarField field(octahedron().mesh(), {1, 0, 0.5, 0.6, 0.5, 0.6});
  const Candidates both = {point_candidates(field, PointKind::extrema)};
  const double apart = std::sqrt(6.0);
  const auto run = [&](std::size_t count, double spacing) {
    return choose_points(field.mesh(), both, count, spacing);
  };
  CHECK(vertices_of(run(1, 0)) == std::vector<Index>{0});
  CHECK(vertices_of(run(2, 0)) == std::vector<Index>{0, 1});
  CHECK(vertices_of(run(2, apart * 0.999)) == std::vector<Index>{0, 1});
  CHECK(run(2, 1).points[1].distance == Approx(apart));
  CHECK(vertices_of(run(2, apart * 1.001)) == std::vector<Index>{0});
  CHECK(run(2, apart * 1.001).too_near == std::vector<std::size_t>{1});
  CHECK(std::isinf(run(1, 0).points[0].distance));
  CHECK(run(0, 0).points.empty());
  CHECK(run(7, 0).points.size() == 2);
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) CHECK_THROWS_AS(run(1, bad), core::InvalidArgument);
}

TEST_CASE("a second list fills up") {
  const ScalarField field = ridge({0, 2, 5, 2, 1, 2, 3, 2, 0});
  const Candidates lists = {point_candidates(field, PointKind::maxima),
                            point_candidates(field, PointKind::extrema)};
  const ChosenPoints chosen = choose_points(field.mesh(), lists, 3, 0.5);
  REQUIRE(chosen.points.size() == 3);
  CHECK(chosen.points[1].source == 0);
  CHECK(chosen.points[2].source == 1);
  CHECK(chosen.points[2].candidate.point.type == CriticalType::minimum);
  CHECK(chosen.too_near == std::vector<std::size_t>{0, 0});
  CHECK(choose_points(field.mesh(), lists, 50, 0).too_near[1] == 2);  // those that are taken already
}

TEST_CASE("the greedy choice agrees with brute force") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const TriangleMesh mesh = random_surface(seed);
    const auto distance = all_distances(mesh);
    for (const NamedField& entry : field_zoo(mesh, seed)) {
      INFO(entry.name);
      const ScalarField& field = entry.field;
      const std::vector<double> persistence =
          persistence::vertex_persistence(persistence::pair_extrema(field), mesh.vertex_count());
      for (const PointKind kind : {PointKind::extrema, PointKind::all}) {
        // Every vertex in turn, the best that is left.
        std::vector<std::pair<double, Index>> left;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          const CriticalType type = morse::classify_vertex(field, v).type;
          if (type == CriticalType::regular || (kind == PointKind::extrema && type == CriticalType::saddle))
            continue;
          double low = HUGE_VAL;
          double high = -HUGE_VAL;
          for (Index u = 0; u < mesh.vertex_count(); ++u)
            if (std::isfinite(distance[v][u])) {
              low = std::min(low, field.value(u));
              high = std::max(high, field.value(u));
            }
          const double rank = std::isinf(persistence[v]) ? high - low : persistence[v];
          if (rank > 0) left.emplace_back(rank, v);
        }
        const double spacing = 0.2137 * mesh.bounding_box().diagonal();
        const Candidates candidates = {point_candidates(field, kind)};
        CHECK(candidates[0].size() == left.size());
        const ChosenPoints chosen = choose_points(mesh, candidates, 7, spacing);
        std::size_t taken = 0;
        for (const morse::ChosenPoint& one : chosen.points) {
          const double best = std::max_element(left.begin(), left.end())->first;
          CHECK(one.candidate.rank == best);  // of equal ranks any
          const auto found = std::find(left.begin(), left.end(), std::pair(best, one.candidate.point.vertex));
          REQUIRE(found != left.end());
          std::erase_if(
              left, [&](const auto& l) { return distance[one.candidate.point.vertex][l.second] < spacing; });
          ++taken;
        }
        CHECK((taken == 7 || left.empty()));
      }
    }
  }
}

TEST_CASE("points are as many as wanted or all that there is room for, and lie apart") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const double diagonal = entry.mesh.bounding_box().diagonal();
    for (const NamedField& named : field_zoo(entry.mesh, 4))
      for (const PointKind kind : kKinds)
        for (const double share : {0.0, 0.1, 0.5}) {
          const Candidates candidates = {point_candidates(named.field, kind)};
          for (const std::size_t count : {1, 5, 1000}) {
            const ChosenPoints chosen = choose_points(entry.mesh, candidates, count, share * diagonal);
            CHECK((chosen.points.size() == count ||
                   chosen.points.size() + chosen.too_near[0] == candidates[0].size()));
            std::set<Index> different;
            for (const auto& point : chosen.points) {
              different.insert(point.candidate.point.vertex);
              CHECK(point.distance >= share * diagonal * (1 - 1e-12));
            }
            CHECK(different.size() == chosen.points.size());
          }
        }
  }
}

TEST_CASE("the choice moves, scales and is renumbered with the surface") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.03, 4);
  const std::vector<double> values = random_values(mesh.vertex_count(), 8);
  const auto run = [&](const TriangleMesh& on, const std::vector<double>& f, double spacing) {
    const Candidates candidates = {point_candidates(ScalarField(on, f), PointKind::all)};
    return vertices_of(choose_points(on, candidates, 20, spacing));
  };
  const std::vector<Index> expected = run(mesh, values, 0.4);
  CHECK(expected.size() == 20);
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  CHECK(run(moved(mesh, turn, Point(3, 1, 2)), values, 0.4) == expected);
  CHECK(run(scaled(mesh, 8), values, 3.2) == expected);
  Soup soup{{mesh.positions().begin(), mesh.positions().end()},
            {mesh.triangles().begin(), mesh.triangles().end()}};
  std::vector<Index> number;
  const TriangleMesh other = shuffled(soup, 5, &number).mesh();
  std::vector<double> moved_values(values.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) moved_values[number[v]] = values[v];
  std::vector<Index> renumbered;
  for (const Index v : expected) renumbered.push_back(number[v]);
  CHECK(run(other, moved_values, 0.4) == renumbered);
}

TEST_CASE("mesh salience is 1 on average, without a unit, and 1 where nothing stands out") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  const std::vector<double> salience = morse::mesh_salience(mesh);
  const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::mixed);
  double sum = 0;
  double total = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    sum += areas[v] * salience[v];
    total += areas[v];
    CHECK(salience[v] >= 0);
  }
  CHECK(sum / total == Approx(1));
  const morse::MeshSalience at_any_scale(mesh);
  CHECK(at_any_scale.at(core::Length::epsilons(8)) == salience);
  CHECK(at_any_scale.at(core::Length::epsilons(4)) == morse::mesh_salience(mesh, core::Length::epsilons(4)));
  const std::vector<double> large = morse::mesh_salience(scaled(mesh, 4));
  for (std::size_t v = 0; v < areas.size(); ++v) CHECK(large[v] == Approx(salience[v]).epsilon(1e-6));
  for (const double one : morse::mesh_salience(grid(12, 9).mesh())) CHECK(one == 1);
  CHECK_THROWS_AS(morse::mesh_salience(mesh, core::Length::epsilons(0)), core::InvalidArgument);
}

TEST_CASE("points of a sample, the same for every number of threads") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  const double spacing = 0.05 * mesh.bounding_box().diagonal();
  const auto run = [&](int threads, bool salient) {
    const core::ThreadLimit limit(threads);
    const std::vector<double> weight = salient ? morse::mesh_salience(mesh) : std::vector<double>();
    const Candidates candidates = {point_candidates(morse::mean_curvature(mesh), PointKind::extrema, weight)};
    return vertices_of(choose_points(mesh, candidates, 40, spacing));
  };
  for (const bool salient : {false, true}) {
    CHECK(run(1, salient).size() == 40);
    CHECK(run(1, salient) == run(4, salient));
  }
  CHECK(run(2, false) != run(2, true));
}
