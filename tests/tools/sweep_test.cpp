#include "morsel/tools/study/sweep.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/plot/sweep_plots.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/sweep_row.h"
#include "morsel/tools/study/comparison.h"
#include "support/counted_method.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using tools::counts_section;
using tools::field_section;
using tools::Json;
using tools::parameters_section;
using tools::parse_variation;
using tools::persistence_section;
using tools::SweepRequest;
using tools::SweepRow;
using Texts = std::vector<std::string>;

namespace {

core::LoadedMesh bumpy_sphere() { return {jittered(sphere(3).mesh(), 0.01, 3), {}}; }

std::vector<SweepRow> sweep(const core::LoadedMesh& mesh, const SweepRequest& request) {
  return run_sweep(mesh, tools::prepare(request));
}

Texts methods_of(const tools::SweepPlan& plan) {
  Texts texts;
  for (const tools::Combination& combination : plan.combinations)
    texts.push_back(to_string(combination.field) + " " + to_string(combination.steps));
  return texts;
}

/// The combination as run by `compare`.
Json by_itself(const core::LoadedMesh& mesh, const tools::Combination& combination) {
  const tools::NamedFunction function =
      tools::Registry::standard().make_function(to_string(combination.field));
  const tools::FieldOutcome field = tools::evaluate_field(mesh, function);
  const tools::MethodChain chain = tools::Registry::standard().make_method(to_string(combination.steps));
  const tools::ChainOutcome made = tools::apply_chain(chain, mesh, function, field.field);
  tools::Timings timings;
  const tools::Measurement measured = tools::measure(made.field, timings);
  return {{"field", field_section(field)},
          {"parameters", parameters_section(made.steps)},
          {"min", made.field.min()},
          {"max", made.field.max()},
          {"critical_points", counts_section(measured.critical_points)},
          {"persistence", persistence_section(measured.diagram, field.field.extent())}};
}

Json comparable(const SweepRow& row) {
  const Json result = row_section(row);
  return {{"field", result["field"]},
          {"parameters", result["method"]["parameters"]},
          {"min", result["method"]["min"]},
          {"max", result["method"]["max"]},
          {"critical_points", result["critical_points"]},
          {"persistence", result["persistence"]}};
}

}  // namespace

TEST_CASE("values of a variation are texts and ranges") {
  const auto values = [](const std::string& text) { return parse_variation("k=" + text).values; };
  CHECK(parse_variation("salient.sigma=8eps").key == "salient.sigma");
  CHECK(values("4eps,8eps") == Texts{"4eps", "8eps"});
  CHECK(values("1..4") == Texts{"1", "2", "3", "4"});
  CHECK(values("2..-1") == Texts{"2", "1", "0", "-1"});
  CHECK(values("0,5..20..5,100") == Texts{"0", "5", "10", "15", "20", "100"});
  CHECK(values("0.1..0.3..0.1") == Texts{"0.1", "0.2", "0.3"});
  CHECK(values("0..1..0.4") == Texts{"0", "0.4", "0.8"});
  CHECK(values("2eps..16eps..x2") == Texts{"2eps", "4eps", "8eps", "16eps"});
  CHECK(values("1%..0.01%..x10") == Texts{"1%", "0.1%", "0.01%"});
  CHECK(values("1..2edges..0.5") == Texts{"1edges", "1.5edges", "2edges"});
  CHECK(values("1std,local,none") == Texts{"1std", "local", "none"});
  CHECK(values("../a.txt,b\\,c=d") == Texts{"../a.txt", "b\\,c=d"});
  CHECK(values("3/17,min-x") == Texts{"3/17", "min-x"});
  CHECK(values("5..5") == Texts{"5"});
}

TEST_CASE("an invalid variation is refused with its text") {
  for (const std::string text :
       {"sigma", "=1", "k=", "k=1,,2", "k=1,1", "k=1..3,2", "k=1..", "k=1..x", "k=1..2..0", "k=1..2..3..4",
        "k=1eps..2edges", "k=-1..1..x2", "k=1..8..x1", "k=1..8..x2eps", "k=0..1..1e-9", "k=1..1e300"})
    CHECK_THROWS_WITH(parse_variation(text),
                      Contains("the variation \"" + text.substr(0, 12)) && Contains("it is written"));
}

TEST_CASE("numbers have one unit") {
  std::string unit;
  CHECK(tools::numbers_of({"4eps", "8eps"}, unit) == std::vector<double>{4, 8});
  CHECK(unit == "eps");
  CHECK(tools::numbers_of({"0.1%", "1%"}, unit) == std::vector<double>{0.1, 1});
  CHECK(tools::numbers_of({"1", "2"}, unit) == std::vector<double>{1, 2});
  CHECK(unit.empty());
  CHECK(tools::numbers_of({"1std", "local"}, unit).empty());
  CHECK(tools::numbers_of({"1", "2eps"}, unit).empty());
}

TEST_CASE("a sweep runs through all combinations, the last variation fastest") {
  CHECK(
      methods_of(tools::prepare({"height", "salient:range=local", {"iterations=1,2", "sigma=4eps,8eps"}})) ==
      Texts{"height salient:range=local,iterations=1,sigma=4eps",
            "height salient:range=local,iterations=1,sigma=8eps",
            "height salient:range=local,iterations=2,sigma=4eps",
            "height salient:range=local,iterations=2,sigma=8eps"});
  CHECK(methods_of(
            tools::prepare({"mean-curvature", "gaussian+tps", {"field.scale=0,1edges", "threshold=1%"}})) ==
        Texts{"mean-curvature:scale=0 gaussian+tps:threshold=1%",
              "mean-curvature:scale=1edges gaussian+tps:threshold=1%"});
  CHECK(
      methods_of(tools::prepare({"height", "gaussian+tps+gaussian", {"3.sigma=1,2", "tps.count=9"}})) ==
      Texts{"height gaussian+tps:count=9+gaussian:sigma=1", "height gaussian+tps:count=9+gaussian:sigma=2"});
  CHECK(methods_of(tools::prepare({"height", "tps", {"height.axis=x,y"}})) ==
        Texts{"height:axis=x tps", "height:axis=y tps"});
  CHECK(methods_of(tools::prepare({"vertex-scalar", "conventional", {"file=a.txt,b.txt"}})).size() == 2);
}

TEST_CASE("a sweep whose keys or values are wrong is refused") {
  const auto refused = [](const SweepRequest& request, const std::string& why) {
    CHECK_THROWS_WITH(tools::prepare(request), Contains(why));
    CHECK_THROWS_AS(tools::prepare(request), core::InvalidArgument);
  };
  refused({"height", "salient", {}}, "nothing varies");
  refused({"height", "salient", {"sgima=1,2"}},
          "has it; did you mean sigma? There are height: axis, direction; salient: preset, iterations");
  refused({"height", "salient", {"q=1,2"}}, "has it; there are height: axis, direction; salient: preset");
  refused({"height", "salient", {"salient.iteratons=1,2"}},
          "no key \"iteratons\"; did you mean iterations? It has: preset, iterations");
  refused({"height", "conventional", {"conventional.q=1,2"}}, "no key \"q\"; it has none");
  refused({"height", "salient", {"saliet.sigma=1,2"}}, "is called saliet; did you mean salient?");
  refused({"mean-curvature", "salient", {"scale=1,2"}}, "any of field.scale, salient.scale; write one");
  refused({"height", "gaussian+gaussian", {"sigma=1,2"}}, "any of 1.sigma, 2.sigma");
  refused({"height", "gaussian+gaussian", {"gaussian.sigma=1,2"}}, "any of 1.sigma, 2.sigma");
  refused({"height", "gaussian", {"2.sigma=1,2"}}, "there is no step 2: the method has 1 step");
  refused({"height", "gaussian", {"tps.count=1,2"}}, "no");
  refused({"height", "gaussian", {"gaussian.count=1,2"}},
          "gaussian has no key \"count\"; it has: iterations");
  refused({"height", "gaussian:sigma=3", {"sigma=1,2"}}, "given as 3 in \"gaussian:sigma=3\": leave it out");
  refused({"height", "gaussian", {"sigma=1,2", "1.sigma=3"}}, "\"1.sigma\" is varied twice");
  refused({"height", "gaussian", {"sigma=1,-2"}}, "gaussian:sigma");
  refused({"hieght", "gaussian", {"sigma=1"}}, "there is no Morse function \"hieght\"");
  refused({"height", "gausian", {"sigma=1"}}, "there is no method \"gausian\"");
  refused({"height", "gaussian", {"sigma=1..2000", "iterations=1..2000"}}, "more than 1000000 combinations");
}

TEST_CASE("the iterates of a method are the results of fewer iterations, bit by bit") {
  const core::LoadedMesh mesh = bumpy_sphere();
  const tools::NamedFunction function = tools::Registry::standard().make_function("mean-curvature");
  const core::ScalarField field = tools::evaluate_field(mesh, function).field;
  std::set<std::string> seen;
  for (const std::string text :
       {"salient:", "salient:range=local,", "salient:precision=single,", "salient:weights=area,",
        "salient:ball=connected,", "salient:scale=1edges,",
        "gaussian:", "laplacian:", "laplacian:scheme=implicit,", "denoise:", "denoise:kind=laplacian,"}) {
    CAPTURE(text);
    std::map<int, std::pair<std::vector<double>, std::vector<core::Index>>> told;
    const auto keep = [](const core::ScalarField& f) {
      return std::pair(std::vector<double>(f.values().begin(), f.values().end()),
                       std::vector<core::Index>(f.ranks().begin(), f.ranks().end()));
    };
    const auto method = [&](int iterations) {
      return tools::Registry::standard().make_method(text + "iterations=" + std::to_string(iterations));
    };
    const tools::MethodChain longest = method(4);
    REQUIRE(longest.steps[0].method->traits().iterates_are_results);
    core::MethodContext context = tools::method_context(mesh, function);
    context.on_iteration = [&](int i, const core::ScalarField& f) {
      told[i] = keep(f);
      return true;
    };
    longest.steps[0].method->apply(field, context);
    for (int i = 1; i <= 4; ++i) {
      const tools::MethodChain chain = method(i);
      CHECK((told.at(i) ==
             keep(chain.steps[0].method->apply(field, tools::method_context(mesh, function)).field)));
    }
    seen.insert(longest.name);
  }
  // A new method that iterates belongs into the list above.
  for (const tools::MethodEntry& entry : tools::Registry::standard().methods()) {
    const Texts keys = tools::Registry::standard().keys_of_method(std::string(entry.name));
    const bool iterates = tools::Registry::standard().traits_of_method(entry.name).iterates;
    CHECK(iterates == seen.contains(entry.name));
    CHECK(std::ranges::count(keys, core::kIterationsKey) == (iterates ? 1 : 0));
  }
  CHECK_FALSE(tools::Registry::standard()
                  .make_method("salient:classify=saliency")
                  .steps[0]
                  .method->traits()
                  .iterates_are_results);
  CHECK_FALSE(tools::Registry::standard()
                  .make_method("salient:accuracy=1e-4")
                  .steps[0]
                  .method->traits()
                  .iterates_are_results);
}

TEST_CASE("a row is the same as that of its combination run alone") {
  const core::LoadedMesh mesh = bumpy_sphere();
  for (const SweepRequest& request : std::vector<SweepRequest>{
           {"mean-curvature", "salient", {"iterations=0..4", "sigma=4eps,12eps"}},
           {"mean-curvature", "salient:classify=saliency", {"iterations=1..3"}},
           {"mean-curvature", "salient:preset=robust", {"iterations=0,1,3"}},
           {"mean-curvature", "salient:until-count=200", {"iterations=0,1,20,40"}},
           {"mean-curvature", "salient:until-count=100000", {"iterations=0,3"}},
           {"mean-curvature",
            "gaussian+laplacian+tps",
            {"1.iterations=0,2", "laplacian.iterations=3,0,1", "count=20,40"}},
           {"mean-curvature", "denoise", {"iterations=3,1", "kind=bilateral,laplacian"}},
           {"mean-curvature", "tps", {"threshold=0%..20%..5%", "estimator=taubin,cotangent"}},
           {"height", "conventional", {"axis=x,y,z"}}}) {
    const tools::SweepPlan plan = tools::prepare(request);
    const std::vector<SweepRow> rows = run_sweep(mesh, plan);
    REQUIRE(rows.size() == plan.combinations.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      CAPTURE(request.method, request.vary.front(), i);
      CHECK(comparable(rows[i]) == by_itself(mesh, plan.combinations[i]));
    }
  }
}

TEST_CASE("the number of iterations that ran is that of all steps together") {
  const std::vector<SweepRow> rows = sweep(
      bumpy_sphere(),
      {"mean-curvature", "gaussian:iterations=2+laplacian:until-count=20", {"laplacian.iterations=1,2,500"}});
  CHECK(rows[0].iterations_run == 3);
  CHECK(rows[0].critical_points.total() > 20);
  CHECK(rows[1].iterations_run == 4);
  CHECK(rows[2].iterations_run.value() < 502);
  CHECK(rows[2].critical_points.total() <= 20);
  CHECK_FALSE(sweep(bumpy_sphere(), {"height", "tps", {"threshold=1%"}})[0].iterations_run);
}

TEST_CASE("iterations of one run are run once") {
  Counts counts;
  const tools::SweepPlan plan =
      tools::prepare({"mean-curvature", "counted+tps", {"iterations=2..20..2", "threshold=1%,5%"}},
                     registry_with_counted(counts));
  const std::vector<SweepRow> rows = run_sweep(bumpy_sphere(), plan);
  CHECK(counts.applications == 1);
  CHECK(counts.iterations == 20);
  CHECK(counts.fields == 10);
  REQUIRE(rows.size() == 20);
  for (std::size_t i = 0; i < rows.size(); ++i)
    CHECK(rows[i].iterations_run == static_cast<std::int64_t>(2 + i / 2 * 2));
}

TEST_CASE("a method of one's own takes part in a sweep") {
  const core::LoadedMesh mesh = bumpy_sphere();
  Counts counts;
  const tools::Registry registry = registry_with_counted(counts);
  const SweepRequest request{"height", "counted", {"iterations=0,3"}};
  CHECK_THROWS_WITH(tools::prepare(request), Contains("there is no method \"counted\""));
  const std::vector<SweepRow> rows = run_sweep(mesh, tools::prepare(request, registry));
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].method_name() == "counted");
  CHECK(rows[0].min == rows[0].field.min);
  CHECK(rows[0].max == rows[0].field.max);
  CHECK(rows[1].min == rows[1].field.min);
  CHECK(rows[1].max - rows[1].min == Approx((rows[0].max - rows[0].min) / 8));
  // Halving keeps the order, and shares of the range.
  CHECK(rows[1].critical_points.total() == rows[0].critical_points.total());
  CHECK(rows[1].persistence.above == rows[0].persistence.above);
}

TEST_CASE("a plan outlives the registry that it was made with") {
  Counts counts;
  const auto plan = [&] {
    return tools::prepare({"height", "counted", {"iterations=1,2"}}, registry_with_counted(counts));
  }();
  run_sweep(bumpy_sphere(), plan);
  CHECK(counts.iterations == 2);
}

TEST_CASE("a row is read back from documents") {
  const auto written = [](const SweepRow& row) {
    return std::pair(tools::row_section(row), tools::seconds_section(row.seconds));
  };
  const auto read = [](const std::pair<Json, Json>& sections) {
    return tools::read_row(tools::JsonView(sections.first, "row"), tools::JsonView(sections.second, "row"));
  };
  std::vector<SweepRow> rows =
      sweep(bumpy_sphere(), {"mean-curvature", "salient+tps", {"iterations=0,2", "threshold=1%"}});
  rows.push_back(sweep(bumpy_sphere(), {"height", "conventional", {"axis=z"}}).front());
  rows.back().field.parameters.emplace_back("none", std::numeric_limits<double>::infinity());
  for (const SweepRow& row : rows) {
    const auto sections = written(row);
    const SweepRow again = read(sections);
    CHECK(written(again) == sections);
    CHECK(again.method_name() == row.method_name());
    CHECK(again.iterations_run == row.iterations_run);
    CHECK(again.critical_points.total() == row.critical_points.total());
    CHECK(again.seconds.sum() == row.seconds.sum());
  }
  CHECK(read(written(rows[0])).steps[1].parameters == rows[0].steps[1].parameters);
  const auto refused = [&](const std::string& pointer, const Json& value) {
    auto sections = written(rows[0]);
    sections.first[Json::json_pointer(pointer)] = value;
    CAPTURE(pointer);
    CHECK_THROWS_AS(read(sections), core::BadInput);
  };
  refused("/more", 1);
  refused("/field/name", 5);
  refused("/field/parameters", Json::array());
  refused("/field/parameters/list", Json::array());
  refused("/field/parameters/large", 18446744073709551615U);
  refused("/method/name", "salient");
  refused("/method/min", 1e300);
  refused("/method/parameters/steps", Json::array());
  refused("/iterations_run", -1);
  refused("/iterations_run", 1.5);
  refused("/critical_points/total", 1);
  refused("/persistence/above/1/percent", 2);
  refused("/persistence/pairs", nullptr);
  auto sections = written(rows[0]);
  sections.second["field"] = -1;
  CHECK_THROWS_AS(read(sections), core::BadInput);
  sections.second = {{"field", 1}, {"method", 1}};
  CHECK_THROWS_AS(read(sections), core::BadInput);
}

TEST_CASE("rows that are known are not made again") {
  const core::LoadedMesh mesh = bumpy_sphere();
  const tools::SweepPlan plan =
      tools::prepare({"mean-curvature", "salient", {"sigma=4eps,8eps", "iterations=1..3"}});
  const std::vector<SweepRow> rows = run_sweep(mesh, plan);
  tools::SweepOptions options;
  options.known = {rows[0], std::nullopt, rows[2], std::nullopt, std::nullopt, std::nullopt};
  std::vector<std::size_t> made;
  options.on_row = [&](std::size_t i, const SweepRow&) { made.push_back(i); };
  const std::vector<SweepRow> again = run_sweep(mesh, plan, options);
  CHECK(made == std::vector<std::size_t>{1, 3, 4, 5});
  for (std::size_t i = 0; i < rows.size(); ++i) CHECK(row_section(again[i]) == row_section(rows[i]));
}

TEST_CASE("a sweep gives the same at any number of threads") {
  const core::LoadedMesh mesh = bumpy_sphere();
  const SweepRequest request{"mean-curvature", "salient+tps", {"iterations=1..3", "threshold=1%,5%"}};
  const auto results = [&](int threads) {
    const core::ThreadLimit limit(threads);
    Json all = Json::array();
    for (const SweepRow& row : sweep(mesh, request)) all.push_back(row_section(row));
    return all;
  };
  const Json one = results(1);
  for (const int threads : {2, 5}) CHECK(results(threads) == one);
}

TEST_CASE("an error of a sweep names its combination") {
  CHECK_THROWS_WITH(sweep(bumpy_sphere(), {"vertex-scalar", "gaussian", {"file=/no-such-file.txt"}}),
                    Contains("vertex-scalar:file=/no-such-file.txt, gaussian: ") && Contains("no-such-file"));
  CHECK_THROWS_AS(sweep(bumpy_sphere(), {"vertex-scalar", "gaussian", {"file=/no-such-file.txt"}}),
                  core::BadInput);
}

namespace {

SweepRow row_with(std::size_t total) {
  SweepRow row;
  row.critical_points.minima = total - 2;
  row.critical_points.maxima = 2;
  return row;
}

}  // namespace

TEST_CASE("plots of a sweep show lines, names or what most combinations do") {
  using tools::plot::sweep_plot;
  {
    const tools::SweepPlan plan = tools::prepare({"height", "gaussian", {"sigma=8eps,1eps,100eps"}});
    const auto plot = sweep_plot(plan, {row_with(20), row_with(40), row_with(10)}, 0);
    REQUIRE(plot);
    CHECK(plot->x.unit == "eps");
    CHECK(plot->x.scale == tools::plot::Scale::log);
    const auto& series = plot->panels.at(0).series;
    REQUIRE(series.size() == 3);  // without the saddles, of which there are none
    CHECK(series[0].name == "total");
    CHECK(series[0].x == std::vector<double>{1, 8, 100});
    CHECK(series[0].y == std::vector<double>{40, 20, 10});
  }
  {
    const tools::SweepPlan plan =
        tools::prepare({"height", "salient", {"range=local,1std", "iterations=1,2,3", "support=2"}});
    std::vector<SweepRow> rows;
    for (std::size_t i = 0; i < 6; ++i) rows.push_back(row_with(10 + i));
    const auto by_range = sweep_plot(plan, rows, 0);
    CHECK(by_range->x.names == Texts{"local", "1std"});
    REQUIRE(by_range->panels[0].series.size() == 3);
    CHECK(by_range->panels[0].series[1].name == "iterations=2");
    CHECK(by_range->panels[0].series[1].y == std::vector<double>{11, 14});
    const auto by_iterations = sweep_plot(plan, rows, 1);
    CHECK(by_iterations->panels[0].series[1].name == "range=1std");
    CHECK(by_iterations->panels[0].series[1].y == std::vector<double>{13, 14, 15});
    CHECK_FALSE(sweep_plot(plan, rows, 2));
  }
  {
    const tools::SweepPlan plan = tools::prepare({"height", "gaussian", {"sigma=1..15", "iterations=1,2"}});
    std::vector<SweepRow> rows;
    for (std::size_t i = 0; i < 30; ++i) rows.push_back(row_with(10 + i));
    const auto plot = sweep_plot(plan, rows, 1);
    const auto& series = plot->panels[0].series;
    REQUIRE(series.size() == 3);
    CHECK(series[0].y == std::vector<double>{38, 39});
    CHECK(series[1].y == std::vector<double>{24, 25});
    CHECK(series[2].y == std::vector<double>{10, 11});
    CHECK_THAT(plot->notes.at(0), Contains("15 combinations"));
  }
}
