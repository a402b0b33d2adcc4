#include "morsel/tools/study/stability.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/plot/stability_plots.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using tools::run_stability;
using tools::StabilityRequest;
using tools::StabilityResult;

namespace {

core::LoadedMesh loaded(const TriangleMesh& mesh) { return {mesh, {}}; }

/// A bumpy sphere: curvature without symmetry.
core::LoadedMesh bumpy() { return loaded(jittered(sphere(3).mesh(), 0.01, 3)); }

StabilityRequest request(std::vector<std::string> methods) {
  StabilityRequest result;
  result.methods = std::move(methods);
  result.trials = 3;
  return result;
}

StabilityResult run(const core::LoadedMesh& mesh, const StabilityRequest& asked) {
  return run_stability(mesh, tools::prepare(asked));
}

/// Everything that must not depend on threads or on other trials.
auto figures(const tools::PerturbationOutcome& outcome) {
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t, double, double>> rows;
  for (const tools::Trial& trial : outcome.trials)
    rows.emplace_back(trial.agreement.reference, trial.agreement.found, trial.agreement.matched,
                      trial.agreement.distances, trial.chance);
  return rows;
}

}  // namespace

TEST_CASE("a surface that is not changed repeats exactly, whatever the radius") {
  for (const std::string radius : {"0", "2%", "4eps", "1.5edges"}) {
    StabilityRequest asked = request({"conventional", "gaussian:iterations=2", "tps:count=30"});
    asked.noise = {0};
    asked.decimate = {1};
    asked.subdivide = {1};
    asked.radius = radius;
    asked.target = 40;
    const StabilityResult result = run(bumpy(), asked);
    CHECK(result.radius == core::parse_length(radius, "radius").on(bumpy().mesh));
    REQUIRE(result.outcomes.size() == 6);
    for (const tools::StabilityOutcome& outcome : result.outcomes) {
      REQUIRE(outcome.perturbations.size() == 3);
      for (const tools::PerturbationOutcome& perturbed : outcome.perturbations) {
        CHECK(perturbed.f_score().mean == 1);
        CHECK(perturbed.recall().mean == 1);
        CHECK(perturbed.precision().mean == 1);
        CHECK(perturbed.drift().mean == 0);
        CHECK(perturbed.f_score().half_width.value_or(0) == 0);
        CHECK(perturbed.found().mean == static_cast<double>(outcome.points.total()));
      }
    }
    CHECK(result.outcomes[0].agreement() == 1);
    CHECK(result.outcomes[2].agreement() == 1);  // cancelled to the same count, the reference is the same
  }
}

TEST_CASE("noise costs points, and more noise more of them") {
  StabilityRequest asked = request({"conventional"});
  asked.noise = {0.01, 0.1, 1};
  const StabilityResult result = run(bumpy(), asked);
  const auto& perturbed = result.outcomes[0].perturbations;
  CHECK(perturbed[0].f_score().mean > perturbed[1].f_score().mean);
  CHECK(perturbed[1].f_score().mean > perturbed[2].f_score().mean);
  CHECK(perturbed[2].f_score().mean < 0.7);
  for (const tools::PerturbationOutcome& outcome : perturbed)
    for (const tools::Trial& trial : outcome.trials) {
      const tools::Agreement& a = trial.agreement;
      CHECK(a.matched <= std::min(a.reference, a.found));
      CHECK(a.f_score() == Approx(2 * a.recall() * a.precision() / (a.recall() + a.precision())));
      CHECK(*a.drift() <= result.radius);
      CHECK(trial.points.total() == a.found);
      CHECK((trial.chance >= 0 && trial.chance <= 1));
    }
}

TEST_CASE("the chance level of a radius that reaches everything is that of equal numbers of each type") {
  StabilityRequest asked = request({"conventional"});
  asked.noise = {0.1};
  asked.radius = "100%";
  const StabilityResult result = run(bumpy(), asked);
  const tools::StabilityOutcome& outcome = result.outcomes[0];
  for (const tools::Trial& trial : outcome.perturbations[0].trials) {
    const double matched = static_cast<double>(std::min(outcome.points.minima, trial.points.minima) +
                                               std::min(outcome.points.saddles, trial.points.saddles) +
                                               std::min(outcome.points.maxima, trial.points.maxima));
    const double f = 2 * matched / static_cast<double>(outcome.points.total() + trial.points.total());
    CHECK(trial.chance == Approx(f));
    CHECK(trial.agreement.f_score() == Approx(f));
  }
}

TEST_CASE("trials whose drift may be too large are counted in a warning") {
  StabilityRequest asked = request({"conventional"});
  asked.noise = {0.1};
  asked.trials = 3;
  StabilityResult result = run(bumpy(), asked);
  CHECK(result.warnings().empty());
  result.outcomes[0].perturbations[0].trials[1].agreement.is_least = false;
  REQUIRE(result.warnings().size() == 1);
  CHECK(result.warnings()[0].find("in 1 of 3 trials") == 0);
}

TEST_CASE("the chance level of a radius of nothing is the share of vertices that are hit") {
  StabilityRequest asked = request({"conventional"});
  asked.noise = {0};
  asked.radius = "0";
  asked.points = tools::PointChoice::extrema;
  asked.trials = 60;
  const core::LoadedMesh mesh = bumpy();
  const StabilityResult result = run(mesh, asked);
  const tools::StabilityOutcome& outcome = result.outcomes[0];
  const auto minima = static_cast<double>(outcome.points.minima);
  const auto maxima = static_cast<double>(outcome.points.maxima);
  const double expected = (minima * minima + maxima * maxima) / (minima + maxima) / mesh.mesh.vertex_count();
  CHECK(outcome.perturbations[0].chance().mean == Approx(expected).epsilon(0.1));
}

TEST_CASE("extrema alone are compared if requested") {
  StabilityRequest asked = request({"conventional"});
  asked.noise = {0.2};
  asked.points = tools::PointChoice::extrema;
  const StabilityResult result = run(bumpy(), asked);
  const tools::StabilityOutcome& outcome = result.outcomes[0];
  CHECK(outcome.with_reference.found == outcome.points.minima + outcome.points.maxima);
  for (const tools::Trial& trial : outcome.perturbations[0].trials)
    CHECK(trial.agreement.found == trial.points.minima + trial.points.maxima);
}

TEST_CASE("a trial does not depend on other trials nor on the number of threads") {
  StabilityRequest asked = request({"conventional", "laplacian:iterations=3"});
  asked.noise = {0.05, 0.3};
  asked.decimate = {0.7};
  asked.target = 30;
  const core::LoadedMesh mesh = bumpy();
  const auto all = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return run(mesh, asked);
  };
  const StabilityResult one = all(1);
  const StabilityResult four = all(4);
  StabilityRequest alone = asked;
  alone.methods = {"laplacian:iterations=3"};
  alone.noise = {0.3};
  alone.trials = 2;
  const StabilityResult few = run(mesh, alone);
  REQUIRE(one.outcomes.size() == 4);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t p = 0; p < 3; ++p)
      CHECK(figures(one.outcomes[i].perturbations[p]) == figures(four.outcomes[i].perturbations[p]));
  for (const std::size_t target : {0, 1}) {
    for (const auto& [p, q] : {std::pair{1, 0}, {2, 1}}) {
      auto expected = figures(one.outcomes[2 * target + 1].perturbations[static_cast<std::size_t>(p)]);
      expected.resize(2);
      CHECK(figures(few.outcomes[target].perturbations[static_cast<std::size_t>(q)]) == expected);
    }
  }
  asked.seed = 2;
  CHECK(figures(run(mesh, asked).outcomes[0].perturbations[0]) != figures(one.outcomes[0].perturbations[0]));
}

TEST_CASE("regression: agreement was with the first field, not with the row's own unsmoothed one") {
  StabilityRequest asked = request({"conventional"});
  asked.fields = {"mean-curvature", "height"};
  asked.noise = {0};
  asked.trials = 1;
  const StabilityResult result = run(bumpy(), asked);
  CHECK(result.outcomes[0].agreement() == 1);
  CHECK(result.outcomes[1].agreement() == 1);
  asked.reference_field = "height";
  const StabilityResult other = run(bumpy(), asked);
  CHECK(other.outcomes[0].agreement() < 1);
  CHECK(other.outcomes[1].agreement() == 1);
}

TEST_CASE("an error in a trial names it, and of several the first is reported") {
  StabilityRequest asked = request({"conventional"});
  asked.fields = {"geodesic:source=0"};  // which decimation drops sooner or later
  asked.decimate = {0.9, 0.05};
  asked.trials = 20;
  const auto error_at = [&](int threads) -> std::string {
    const core::ThreadLimit limit(threads);
    try {
      run(bumpy(), asked);
    } catch (const core::InvalidArgument& error) {
      return error.what();
    } catch (const core::BadInput& error) {
      return error.what();
    }
    return "none";
  };
  const std::string error = error_at(1);
  CHECK_THAT(error, Catch::StartsWith("decimation 0.") && Catch::Contains(", trial ") &&
                        Catch::Contains("geodesic:source=0: ") && Catch::Contains("vertex 0"));
  CHECK(error_at(4) == error);
}

TEST_CASE("plots show F over noise and over vertices, a panel for each count") {
  StabilityRequest asked = request({"conventional", "gaussian:iterations=2"});
  asked.noise = {0.3, 0.1};
  asked.decimate = {0.5};
  asked.subdivide = {3, 1};
  asked.target = 40;
  asked.trials = 1;
  const core::LoadedMesh clean = bumpy();
  const tools::StabilityPlan plan = tools::prepare(asked);
  const StabilityResult result = run_stability(clean, plan);
  const auto score = [&](std::size_t outcome, std::size_t perturbation) {
    return result.outcomes[outcome].perturbations[perturbation].f_score().mean;
  };
  const auto noise = tools::plot::noise_plot(plan, result);
  REQUIRE(noise);
  REQUIRE(noise->panels.size() == 2);
  CHECK(noise->panels[1].title == "40 points");
  for (std::size_t panel = 0; panel < 2; ++panel) {
    const auto& series = noise->panels[panel].series;
    REQUIRE(series.size() == 4);  // each after its chance level
    for (std::size_t m = 0; m < 2; ++m) {
      const auto& line = series[2 * m + 1];
      CHECK(line.name == asked.methods[m]);
      CHECK(line.x == std::vector<double>{0.1, 0.3});
      CHECK(line.y == std::vector<double>{score(2 * panel + m, 1), score(2 * panel + m, 0)});
      CHECK(series[2 * m].name.empty());
      CHECK(series[2 * m].color == line.color);
      CHECK(series[2 * m].y[0] == result.outcomes[2 * panel + m].perturbations[1].chance().mean);
    }
  }
  const auto vertices = tools::plot::vertices_plot(plan, result, clean.mesh);
  REQUIRE(vertices);
  const auto& series = vertices->panels.at(0).series;
  REQUIRE(series.size() == 8);  // each in two parts, before and after the clean surface
  CHECK(series[1].x == std::vector<double>{0.5});
  CHECK(series[1].y == std::vector<double>{score(0, 2)});
  const tools::PerturbedMesh finer = tools::perturb(clean, plan.perturbations[3], 1, 0);
  const double share = static_cast<double>(finer.loaded.mesh.vertex_count()) / clean.mesh.vertex_count();
  CHECK(series[3].x == std::vector<double>{1, share});
  CHECK(series[3].y == std::vector<double>{score(0, 4), score(0, 3)});
  CHECK(series[3].name == series[1].name);
  CHECK(series[3].color == series[1].color);
}

TEST_CASE("plots of several fields have their texts in the legend or, if they are long, in notes") {
  const core::LoadedMesh clean = bumpy();
  const auto noise = [&](std::vector<std::string> fields) {
    StabilityRequest asked = request({"conventional"});
    asked.fields = std::move(fields);
    asked.noise = {0.1};
    asked.trials = 1;
    const tools::StabilityPlan plan = tools::prepare(asked);
    return tools::plot::noise_plot(plan, run_stability(clean, plan)).value();
  };
  const tools::plot::Plot brief = noise({"height", "height:axis=x"});
  CHECK(brief.panels.at(0).series.at(3).name == "height:axis=x, conventional");
  CHECK(brief.notes.size() == 1);
  const std::string long_one = "mean-curvature:estimator=cotangent";
  const tools::plot::Plot numbered = noise({"height", long_one});
  CHECK(numbered.panels.at(0).series.at(3).name == "field 2, conventional");
  CHECK(numbered.notes.back() == "field 2: " + long_one);
}

TEST_CASE("plots over a single strength of noise have marks that can be told apart") {
  StabilityRequest asked = request(std::vector<std::string>(8, "conventional"));
  asked.noise = {0.1};
  asked.trials = 1;
  const core::LoadedMesh clean = bumpy();
  const tools::StabilityPlan plan = tools::prepare(asked);
  const auto plot = tools::plot::noise_plot(plan, run_stability(clean, plan));
  const auto& series = plot.value().panels.at(0).series;
  REQUIRE(series.size() == 8);
  CHECK(series[0].draw == tools::plot::Draw::marks);
  CHECK(series[7].color == series[0].color);
  CHECK(series[7].mark != series[0].mark);
}

TEST_CASE("what did not happen to the surface is not plotted, and many lines are without chance levels") {
  StabilityRequest asked = request(std::vector<std::string>(8, "conventional"));
  asked.noise = {0.1};
  asked.trials = 1;
  const core::LoadedMesh clean = bumpy();
  const tools::StabilityPlan plan = tools::prepare(asked);
  const StabilityResult result = run_stability(clean, plan);
  CHECK_FALSE(tools::plot::vertices_plot(plan, result, clean.mesh));
  const auto noise = tools::plot::noise_plot(plan, result);
  REQUIRE(noise);
  CHECK(noise->panels.at(0).series.size() == 8);
  CHECK(noise->notes.empty());
}

TEST_CASE("stability requests are checked") {
  const auto refused = [](auto change) {
    StabilityRequest asked;
    change(asked);
    CHECK_THROWS_AS(tools::prepare(asked), core::InvalidArgument);
  };
  refused([](auto& r) { r.noise = {-0.1}; });
  refused([](auto& r) { r.noise = {std::nan("")}; });
  refused([](auto& r) { r.decimate = {0}; });
  refused([](auto& r) { r.decimate = {1.5}; });
  refused([](auto& r) { r.subdivide = {1.5}; });
  refused([](auto& r) { r.subdivide = {17}; });
  refused([](auto& r) { r.trials = 0; });
  refused([](auto& r) { r.target = 0; });
  refused([](auto& r) { r.radius = "-1%"; });
  refused([](auto& r) { r.radius = "-1eps"; });
  refused([](auto& r) { r.radius = "far"; });
  refused([](auto& r) { r.methods = {"nonsense"}; });
  refused([](auto& r) { r.methods = {}; });
  refused([](auto& r) { r.reference = "nonsense"; });
  refused([](auto& r) { r.reference_field = "nonsense"; });
  refused([](auto& r) {
    r.fields = {"vertex-scalar:file=values.txt"};
    r.subdivide = {2};
  });
  CHECK(tools::prepare(StabilityRequest{}).perturbations.size() == 4);
}
