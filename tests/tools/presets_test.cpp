#include "morsel/tools/study/presets.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using core::LengthUnit;
using tools::apply_preset;
using tools::diffusion_for;

namespace {

/// The critical points that each method leaves.
struct Points : tools::ComparisonSink {
  std::vector<std::vector<std::pair<Index, morse::CriticalType>>> rows;

  void field(const tools::FieldOutcome& /*outcome*/) override {}
  void method(const tools::MethodOutcome& outcome) override {
    auto& row = rows.emplace_back();
    for (const morse::CriticalPoint& point : outcome.measurement.critical_points.points)
      row.emplace_back(point.vertex, point.type);
  }
};

auto points_of(const TriangleMesh& mesh, const tools::ComparisonRequest& request) {
  Points points;
  tools::run_comparison({mesh, {}}, tools::prepare(request), {&points});
  return points.rows;
}

tools::ComparisonRequest comparison(std::string_view preset, std::optional<std::size_t> target = {}) {
  tools::ComparisonRequest request;
  request.target = target;
  apply_preset(preset, request);
  return request;
}

tools::StabilityRequest stability(std::string_view preset, std::optional<std::size_t> target = {}) {
  tools::StabilityRequest request;
  request.target = target;
  apply_preset(preset, request);
  return request;
}

}  // namespace

TEST_CASE("presets are comparisons and studies of stability") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.02, 5);
  for (const tools::Preset& preset : tools::presets()) {
    INFO(preset.name);
    const tools::ComparisonRequest request = comparison(preset.name);
    CHECK(request.field == preset.field);
    CHECK(tools::prepare(request).chains.size() == preset.methods.size());
    CHECK(points_of(mesh, request).size() == preset.methods.size());
    const tools::StabilityRequest study = stability(preset.name);
    CHECK(study.fields == std::vector<std::string>{preset.field});
    const tools::StabilityPlan plan = tools::prepare(study);
    CHECK(plan.chains.size() >= 2);
    CHECK(plan.chains.front().specification == "conventional");
  }
  tools::ComparisonRequest request;
  CHECK_THROWS_WITH(apply_preset("papper", request), Contains("did you mean paper?"));
  tools::StabilityRequest study;
  CHECK_THROWS_AS(apply_preset("", study), core::InvalidArgument);
}

TEST_CASE("a study of stability has a preset's methods without counts of other rows") {
  using Texts = std::vector<std::string>;
  CHECK(stability("noise").methods == Texts{"conventional", "salient", "salient:preset=robust"});
  CHECK(stability("paper").methods == Texts{"conventional", "salient", "tps:threshold=0.1%"});
  CHECK(stability("molecule").methods == Texts{"conventional", "salient:range=local,support=1"});
}

TEST_CASE("the diffusion of a preset follows from the wanted number of points") {
  for (const std::size_t points : {2, 10, 20, 60}) {
    const core::Length diffusion = diffusion_for(points);
    CHECK(diffusion.unit == LengthUnit::root_area);
    // A square of it is always the same part of a point's share of the surface.
    CHECK(diffusion.value * diffusion.value * static_cast<double>(points) == Approx(0.47 * 0.47));
    CHECK(diffusion_for(4 * points).value == Approx(diffusion.value / 2));
  }
  CHECK(diffusion_for(0).value == diffusion_for(1).value);

  CHECK(comparison("resampled").field == comparison("resampled", tools::kPresetPoints).field);
  const tools::ComparisonRequest few = comparison("resampled", 20);
  CHECK_THAT(few.field, Contains("scale=0.01rootarea") && Contains("diffusion=0.105rootarea"));
  CHECK_THAT(few.methods[1], Contains("time=0.105rootarea"));
  const tools::ComparisonRequest many = comparison("resampled", 80);
  CHECK_THAT(many.field, Contains("scale=0.01rootarea") && Contains("diffusion=0.0525rootarea"));
  CHECK_THAT(many.methods[1], Contains("time=0.0525rootarea"));
  CHECK(stability("resampled", 80).fields.front() == many.field);
  CHECK(comparison("noise", 80).methods == comparison("noise").methods);
  for (const std::size_t extreme : {std::size_t{1}, std::size_t{1'000'000}})
    CHECK_NOTHROW(tools::prepare(comparison("resampled", extreme)));
}

TEST_CASE("the preset for resampled surfaces has no length that depends on triangles or pose") {
  const tools::ComparisonRequest request = comparison("resampled");
  std::string all = request.field;
  for (const std::string& method : request.methods) all += " " + method;
  CHECK_THAT(all, !Contains("edges") && !Contains("eps") && !Contains("%"));
}

TEST_CASE("the points of the preset for resampled surfaces move, turn and scale with the surface") {
  const TriangleMesh mesh = jittered(torus(40, 22).mesh(), 0.1, 7);
  const tools::ComparisonRequest request = comparison("resampled", 20);
  const auto points = points_of(mesh, request);
  REQUIRE(points.size() == 3);
  CHECK(points[1].size() >= 8);
  CHECK(points_of(scaled(mesh, 8), request) == points);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(points_of(moved(mesh, 3.7 * turn, Point(3, -1, 2)), request) == points);
}
