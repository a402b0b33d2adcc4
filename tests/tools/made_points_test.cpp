#include "morsel/tools/study/made_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/tools/study/made_field.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using tools::MadePoints;
using tools::PointsRequest;

namespace {

MadePoints run(const core::LoadedMesh& loaded, const tools::FieldRequest& field,
               const PointsRequest& request) {
  return make_points(prepare(request), loaded, make_field(tools::prepare(field), loaded));
}

std::vector<Index> vertices_of(const MadePoints& made) {
  std::vector<Index> vertices;
  for (const morse::ChosenPoint& point : made.chosen.points) vertices.push_back(point.candidate.point.vertex);
  return vertices;
}

core::LoadedMesh noisy_sphere() { return {jittered(sphere(3).mesh(), 0.03, 4), {}}; }

}  // namespace

TEST_CASE("points of a field are as many as asked for, or the reason why fewer is told") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.count = 10;
  const MadePoints ten = run(loaded, {}, request);
  CHECK(ten.chosen.points.size() == 10);
  CHECK(ten.note.empty());
  CHECK(ten.places == vertices_of(ten));
  CHECK_FALSE(ten.mean_percentile());
  CHECK_FALSE(ten.percentile(3));
  CHECK(ten.chosen.spacing == 0.05 * loaded.mesh.bounding_box().diagonal());
  request.count = 10000;
  const MadePoints all = run(loaded, {}, request);
  CHECK(all.chosen.points.size() < 10000);
  CHECK(all.chosen.points.size() + all.chosen.too_near[0] == all.candidates[0]);
  CHECK_THAT(all.note, Catch::StartsWith(std::to_string(all.chosen.points.size()) +
                                         " of 10,000 points: mean-curvature has") &&
                           Catch::Contains("nearer than"));
  request.kind = morse::PointKind::saddles;
  const MadePoints none = run(loaded, {"height", "tps:threshold=90%", {}}, request);
  CHECK(none.note == "0 of 10,000 points: height has no saddle that stands out at all");
  CHECK_FALSE(none.mean_percentile());
}

TEST_CASE("a second field fills up only where the first has too few points") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.fill = "mean-curvature";
  request.count = 2;
  const MadePoints two = run(loaded, {"height", "tps:threshold=50%", {}}, request);
  CHECK_FALSE(two.fill);
  CHECK(two.chosen.points.size() == 2);
  request.count = 12;
  const MadePoints twelve = run(loaded, {"height", "tps:threshold=50%", {}}, request);
  REQUIRE(twelve.fill);
  CHECK(twelve.fill->name == "mean-curvature");
  CHECK(twelve.chosen.points.size() == 12);
  CHECK(twelve.candidates[0] == 2);
  CHECK(std::count_if(twelve.chosen.points.begin(), twelve.chosen.points.end(),
                      [](const morse::ChosenPoint& p) { return p.source == 1; }) == 10);
  request.count = 10000;
  CHECK_THAT(run(loaded, {"height", "tps:threshold=50%", {}}, request).note,
             Catch::Contains("height has 2 extrema") && Catch::Contains("; mean-curvature has"));
}

TEST_CASE("salience has the method's scale unless it is given") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.count = 5;
  CHECK_FALSE(run(loaded, {}, request).scale);
  request.rank = morse::PointRank::salience;
  CHECK(run(loaded, {}, request).scale == 8 * loaded.mesh.epsilon());
  CHECK(run(loaded, {"mean-curvature", "gaussian:sigma=0.25", {}}, request).scale == 0.25);
  request.scale = core::Length::percent(4);
  CHECK(run(loaded, {"mean-curvature", "gaussian:sigma=0.25", {}}, request).scale ==
        0.04 * loaded.mesh.bounding_box().diagonal());
}

TEST_CASE("a maker chooses of several fields what it would of each alone") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.count = 30;
  request.rank = morse::PointRank::salience;
  request.fill = "height";
  request.percentiles = true;
  const tools::PointsPlan plan = prepare(request);
  tools::PointMaker maker(plan, loaded);
  std::set<double> scales;
  for (const char* method : {"conventional", "gaussian:sigma=0.25", "salient:sigma=0.4", "tps:count=6"}) {
    INFO(method);
    const tools::FieldRequest field{"mean-curvature", method, {}};
    const tools::MadeField made = make_field(tools::prepare(field), loaded);
    const MadePoints one = maker.make(made.for_points());
    const MadePoints alone = run(loaded, field, request);
    CHECK(vertices_of(one) == vertices_of(alone));
    CHECK(one.scale == alone.scale);
    CHECK(one.percentiles == alone.percentiles);
    CHECK(one.fill.has_value() == alone.fill.has_value());
    scales.insert(*one.scale);
    // Another number: the first of them.
    std::vector<Index> few = vertices_of(maker.make(made.for_points(), 5));
    std::vector<Index> first = vertices_of(one);
    first.resize(5);
    CHECK(few == first);
  }
  CHECK(scales.size() == 3);  // 8eps twice
}

TEST_CASE("percentiles are taken where they are asked for") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.count = 10;
  request.percentiles = true;
  const MadePoints ten = run(loaded, {}, request);
  const std::vector<double> all = tools::saliency_percentiles(loaded.mesh);
  double sum = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(ten.percentile(i) == all[ten.places[i]]);
    sum += all[ten.places[i]];
  }
  CHECK(*ten.mean_percentile() == Approx(sum / 10));
  request.kind = morse::PointKind::saddles;
  const MadePoints none = run(loaded, {"height", "tps:threshold=90%", {}}, request);
  CHECK(none.has_percentiles);
  CHECK_FALSE(none.mean_percentile());
}

TEST_CASE("saliency percentiles are half on average") {
  const core::LoadedMesh loaded = noisy_sphere();
  const std::vector<double> percentiles = tools::saliency_percentiles(loaded.mesh);
  CHECK(std::accumulate(percentiles.begin(), percentiles.end(), 0.0) /
            static_cast<double>(percentiles.size()) ==
        Approx(0.5));
  for (const double share : tools::saliency_percentiles(grid(9, 7).mesh())) CHECK(share == 0.5);
  const TriangleMesh point =
      loaded.mesh.with_positions(std::vector<Point>(loaded.mesh.vertex_count(), Point(1, 2, 3)));
  CHECK(tools::saliency_percentiles(point)[7] == 0.5);
}

TEST_CASE("points of a request are the same for every number of threads") {
  const core::LoadedMesh loaded = noisy_sphere();
  PointsRequest request;
  request.rank = morse::PointRank::salience;
  const auto vertices = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return vertices_of(run(loaded, {}, request));
  };
  CHECK(vertices(1) == vertices(4));
}

TEST_CASE("bad requests for points are refused") {
  const auto refuse = [](const auto& change, const char* naming) {
    PointsRequest request;
    change(request);
    CHECK_THROWS_WITH(prepare(request), Catch::Contains(naming));
  };
  refuse([](PointsRequest& r) { r.count = 0; }, "at least 1");
  refuse([](PointsRequest& r) { r.spacing = core::Length::percent(-1); }, "-1%");
  refuse([](PointsRequest& r) { r.fill = "curvature"; }, "curvature");
  refuse([](PointsRequest& r) { r.scale = core::Length::epsilons(8); }, "rank=salience");
  refuse(
      [](PointsRequest& r) {
        r.rank = morse::PointRank::salience;
        r.scale = core::Length::epsilons(0);
      },
      "above 0");
}
