#include "morsel/tools/study/landmarks.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <mutex>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/study/perturbation.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using tools::LandmarksOnMesh;
using tools::LandmarksPlan;
using tools::LandmarksRequest;
using tools::LandmarksSummary;
using tools::MarkedMesh;

namespace {

/// Where a body has its tips.
const std::vector<Point>& tips() {
  static const std::vector<Point> kTips = {Point(1, 0, 0),       Point(0, 1, 0),       Point(0, -0.6, 0.8),
                                           Point(-0.8, 0, -0.6), Point(0, -0.8, -0.6), Point(-0.6, 0, 0.8)};
  return kTips;
}

/// The body, marked at the vertices next to its tips.
MarkedMesh marked(const TriangleMesh& mesh, const Eigen::Matrix3d& linear = Eigen::Matrix3d::Identity(),
                  const Point& offset = Point::Zero()) {
  std::vector<Point> places;
  for (const Point& tip : tips()) places.push_back(linear * (1.5 * tip) + offset);
  return {{mesh, {}}, nearest_vertices(mesh, places), {}};
}

TriangleMesh perturbed(const TriangleMesh& mesh, tools::PerturbationKind kind, double amount) {
  return tools::perturb({mesh, {}}, {kind, amount, tools::NoiseKind::normal}, 1, 0).loaded.mesh;
}

class Meshes : public tools::MarkedMeshes {
 public:
  explicit Meshes(std::vector<MarkedMesh> meshes) : meshes_(std::move(meshes)) {}
  std::size_t size() const override { return meshes_.size(); }
  std::string name(std::size_t i) const override { return "mesh " + std::to_string(i); }
  MarkedMesh load(std::size_t i, const core::Progress&) override {
    const std::lock_guard lock(mutex_);
    loaded.push_back(i);
    return meshes_[i];
  }
  std::vector<std::size_t> loaded;

 private:
  std::vector<MarkedMesh> meshes_;
  std::mutex mutex_;
};

/// The body as it is, moved, noisy, with half of the vertices, and with other triangles.
std::vector<MarkedMesh> bodies() {
  const TriangleMesh body = with_tips(tips());
  const Eigen::Matrix3d turn = 3 * Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const Point offset(5, -7, 1);
  return {marked(body), marked(moved(body, turn, offset), turn, offset),
          marked(perturbed(body, tools::PerturbationKind::noise, 0.1)),
          marked(perturbed(body, tools::PerturbationKind::decimation, 0.5)),
          marked(perturbed(with_tips(tips(), 3), tools::PerturbationKind::subdivision, 3))};
}

std::vector<LandmarksOnMesh> run(const std::vector<MarkedMesh>& meshes, const LandmarksRequest& request,
                                 tools::LandmarksStore* store = nullptr) {
  Meshes source(meshes);
  return run_landmarks(source, tools::prepare(request), {}, store);
}

LandmarksRequest request() {
  LandmarksRequest result;
  result.choice.kind = morse::PointKind::maxima;
  result.resamples = 1000;
  return result;
}

auto figures(const LandmarksOnMesh& mesh) {
  std::vector<double> all = {static_cast<double>(mesh.marks), static_cast<double>(mesh.wanted), mesh.radius};
  for (const tools::LandmarkRow& row : mesh.rows) {
    all.insert(all.end(), row.points.begin(), row.points.end());
    for (const tools::MarkScore& score : row.sets)
      for (const double value : {score.recall(), score.precision(), score.one_to_one.distances})
        all.push_back(value);
  }
  return all;
}

}  // namespace

TEST_CASE("the landmark field finds a body's tips, moved, noisy and with other triangles; chance does not") {
  const auto results = run(bodies(), request());
  REQUIRE(results.size() == bodies().size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    INFO("body " << i);
    const LandmarksOnMesh& mesh = results[i];
    CHECK((mesh.marks == tips().size() && mesh.wanted == tips().size()));
    REQUIRE(mesh.rows.size() == 3);
    const tools::MarkScore& found = mesh.rows[0].sets.at(0);
    CHECK(found.points() == tips().size());
    CHECK(found.f_score() == 1);
    CHECK(found.one_to_one.matched == tips().size());
    CHECK((found.false_negatives() == 0 && found.false_positives() == 0));
    CHECK(mesh.rows[0].note.empty());
    CHECK(mesh.rows[1].sets.size() == tools::kPlacements);
    CHECK(mesh.rows[1].points.empty());
    CHECK(mesh.rows[1].mean([](const tools::MarkScore& score) { return score.f_score(); }) < 0.4);
    CHECK(mesh.rows[2].points.size() == tips().size());
  }
  const auto summaries = summarize(tools::prepare(request()), results);
  CHECK(summaries[0].f_score.mean == 1);
  CHECK((summaries[0].f_score.interval->low == 1 && summaries[0].f_score_gain.mean == 0));
  CHECK(summaries[1].f_score_gain.interval->high < -0.5);
  CHECK(summaries[0].false_negatives_within.front() > 0);  // not every tip's own vertex
  CHECK(summaries[0].false_negatives_within.back() == 0);
}

TEST_CASE("points as many as wanted, or a reason; a second field fills up") {
  LandmarksRequest asked = request();
  asked.count = 40;
  const std::vector<MarkedMesh> one = {bodies()[0]};
  const LandmarksOnMesh few = run(one, asked)[0];
  CHECK(few.wanted == 40);
  CHECK(few.rows[0].points.size() < 40);
  CHECK_THAT(few.rows[0].note, Contains(" of 40 points: gaussian-curvature has"));
  CHECK(few.rows[2].points.size() == 40);
  CHECK(summarize(tools::prepare(asked), {few})[0].fewer == 1);
  asked.choice.fill = "height";
  asked.choice.kind = morse::PointKind::all;
  asked.choice.spacing = core::Length::absolute(0);
  asked.count = few.rows[0].points.size() + 100;
  const LandmarksOnMesh filled = run(one, asked)[0];
  REQUIRE(filled.rows[0].fill);
  CHECK(filled.rows[0].fill->name == "height");
  asked.count = 3;
  const LandmarksOnMesh three = run(one, asked)[0];
  CHECK(three.rows[0].points.size() == 3);
  CHECK(three.rows[0].sets[0].recall() <= 0.5);
  CHECK_FALSE(three.rows[0].fill);
}

TEST_CASE("rows are those of each field with each method, then chance") {
  LandmarksRequest asked = request();
  asked.fields = {"height", "mean-curvature"};
  asked.methods = {"conventional", "gaussian:iterations=2+tps:count=20"};
  const LandmarksPlan plan = tools::prepare(asked);
  REQUIRE(plan.rows() == 6);
  CHECK(plan.name_of(1) == "height, gaussian:iterations=2+tps:count=20");
  CHECK(plan.name_of(2) == "mean-curvature, conventional");
  CHECK(plan.name_of(4) == "random");
  CHECK(plan.name_of(5) == "farthest points");
  const LandmarksOnMesh result = run({bodies()[0]}, asked)[0];
  REQUIRE(result.rows.size() == 6);
  CHECK(result.fields.size() == 2);
  CHECK(result.rows[3].steps.size() == 2);
  CHECK(result.rows[2].points != result.rows[3].points);
  // A row does not depend on the others, nor does chance.
  LandmarksRequest alone = asked;
  alone.fields = {"mean-curvature"};
  alone.methods = {"gaussian:iterations=2+tps:count=20"};
  const LandmarksOnMesh single = run({bodies()[0]}, alone)[0];
  CHECK(single.rows[0].points == result.rows[3].points);
  CHECK(single.rows[2].points == result.rows[5].points);
  CHECK(single.rows[1].sets[3].one_to_one.distances == result.rows[4].sets[3].one_to_one.distances);
  CHECK(tools::prepare(alone).name_of(0) == "mean-curvature, gaussian:iterations=2+tps:count=20");
  CHECK(tools::prepare(LandmarksRequest()).name_of(0) == "gaussian-curvature:estimator=diffused");
}

TEST_CASE("landmarks do not depend on the number of threads, on other meshes, but on the seed") {
  const auto all = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return run(bodies(), request());
  };
  const auto one = all(1);
  const auto four = all(4);
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(figures(one[i]) == figures(four[i]));
  CHECK(figures(run({bodies()[2]}, request())[0]) == figures(one[2]));
  LandmarksRequest other = request();
  other.seed = 2;
  const LandmarksOnMesh reseeded = run({bodies()[2]}, other)[0];
  CHECK(reseeded.rows[0].points == one[2].rows[0].points);
  CHECK(figures(reseeded) != figures(one[2]));
}

TEST_CASE("results that are known are taken, and new ones are kept") {
  class Store : public tools::LandmarksStore {
   public:
    std::optional<LandmarksOnMesh> find(std::size_t mesh) override {
      const std::lock_guard lock(mutex_);
      const auto entry = known.find(mesh);
      return entry == known.end() ? std::nullopt : std::optional(entry->second);
    }
    void add(std::size_t mesh, const LandmarksOnMesh& result) override {
      const std::lock_guard lock(mutex_);
      known[mesh] = result;
    }
    std::map<std::size_t, LandmarksOnMesh> known;

   private:
    std::mutex mutex_;
  } store;
  const auto whole = run(bodies(), request(), &store);
  REQUIRE(store.known.size() == whole.size());
  store.known.erase(1);
  store.known[3].spacing = 77;
  Meshes source(bodies());
  const auto again = run_landmarks(source, tools::prepare(request()), {}, &store);
  CHECK(source.loaded == std::vector<std::size_t>{1});
  CHECK(again[3].spacing == 77);
  CHECK(figures(again[1]) == figures(whole[1]));
}

TEST_CASE("means over meshes that are computed by hand") {
  const auto score = [](std::size_t hit, std::size_t points) {
    tools::MarkScore result;
    result.one_to_one = {4, points, hit, 0.5 * static_cast<double>(hit)};
    result.marks_hit = result.points_hit = result.detected = hit;
    result.detected_within.assign(LandmarksPlan::kCurveSteps + 1, hit);
    return result;
  };
  LandmarksRequest asked = request();
  asked.fields = {"height", "mean-curvature"};
  const LandmarksPlan plan = tools::prepare(asked);
  const auto mesh = [&](std::size_t first, std::size_t second) {
    LandmarksOnMesh result;
    result.marks = result.wanted = 4;
    result.radius = 2;
    result.rows.resize(4);
    result.rows[0].sets = {score(first, 4)};
    result.rows[1].sets = {score(second, 4)};
    result.rows[2].sets = {score(0, 4), score(1, 4)};
    result.rows[3].sets = {score(0, 0)};
    return result;
  };
  const std::vector<LandmarksSummary> sums = summarize(plan, {mesh(4, 2), mesh(2, 2)});
  CHECK(sums[0].f_score.mean == 0.75);
  CHECK((sums[0].f_score.interval->low == 0.5 && sums[0].f_score.interval->high == 1));
  CHECK(sums[1].f_score.mean == 0.5);
  CHECK(sums[1].f_score_gain.mean == -0.25);
  CHECK((sums[1].f_score_gain.interval->low == -0.5 && sums[1].f_score_gain.interval->high == 0));
  CHECK(sums[2].recall.mean == 0.125);
  CHECK(sums[0].distance == 0.25);  // half a unit, of a radius of two
  CHECK_FALSE(sums[3].distance);
  CHECK((sums[3].fewer == 2 && sums[3].precision.mean == 1 && sums[3].points.mean == 0));
  CHECK(sums[0].false_negatives_within[7] == 0.25);
  CHECK_FALSE(summarize(plan, {mesh(4, 2)})[0].f_score.interval);
}

TEST_CASE("bad requests for landmarks are refused, and errors name the mesh and the row") {
  const auto refuse = [](const auto& spoil, const char* what) {
    LandmarksRequest bad;
    spoil(bad);
    CHECK_THROWS_WITH(tools::prepare(bad), Contains(what));
    CHECK_THROWS_AS(tools::prepare(bad), core::InvalidArgument);
  };
  refuse([](auto& r) { r.fields = {"curvature"}; }, "curvature");
  refuse([](auto& r) { r.fields = {}; }, "needed");
  refuse([](auto& r) { r.methods = {"smooth"}; }, "smooth");
  refuse([](auto& r) { r.count = 0; }, "at least 1");
  refuse([](auto& r) { r.radius = core::Length::percent(-1); }, "radius of a hit");
  refuse([](auto& r) { r.radius = core::Length::absolute(std::nan("")); }, "radius of a hit");
  refuse([](auto& r) { r.largest_radius = core::Length::percent(0); }, "above 0");
  refuse([](auto& r) { r.resamples = 10; }, "100 resamples");
  refuse([](auto& r) { r.first = 2; }, "0 or 1");
  refuse([](auto& r) { r.choice.spacing = core::Length::percent(-2); }, "spacing");
  refuse([](auto& r) { r.choice.fill = "water"; }, "water");

  LandmarksRequest asked = request();
  asked.fields = {"height", "vertex-scalar:property=red"};
  CHECK_THROWS_WITH(run({bodies()[0], bodies()[1]}, asked),
                    Catch::StartsWith("mesh 0: vertex-scalar:property=red: "));
}
