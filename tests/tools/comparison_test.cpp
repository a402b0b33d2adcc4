#include "morsel/tools/study/comparison.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/segments.h"
#include "morsel/tools/report/comparison_table.h"
#include "morsel/tools/study/level_builder.h"
#include "morsel/tools/study/made_field.h"
#include "morsel/tools/study/persistence_levels.h"
#include "morsel/tools/study/summary.h"

#include "support/fields.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;

namespace {

/// Invariants of any field that any method returns.
void check_invariants(const core::ScalarField& field) {
  const TriangleMesh& mesh = field.mesh();
  tools::Timings timings;
  const tools::Measurement m = tools::measure(field, timings);
  const auto& points = m.critical_points;

  // Euler, component by component.
  std::vector<long> sum(mesh.component_count(), 0);
  std::vector<long> multiplicity(mesh.component_count(), 0);
  std::set<Index> minima;
  for (const auto& p : points.points) {
    const Index c = mesh.component_of_vertex(p.vertex);
    const bool saddle = p.type == morse::CriticalType::saddle;
    sum[c] += saddle ? -long{p.multiplicity} : 1;
    if (saddle) multiplicity[c] += p.multiplicity;
    if (p.type == morse::CriticalType::minimum) minima.insert(p.vertex);
  }
  for (Index c = 0; c < mesh.component_count(); ++c) CHECK(sum[c] == mesh.euler_characteristic(c));

  // Every saddle's multiplicity is paired or essential.
  std::size_t essential = 0;
  for (const auto& saddle : m.diagram.essential_saddles) essential += saddle.count;
  CHECK(m.diagram.pairs.size() + essential == points.saddle_multiplicity);
  CHECK(essential == 2 * std::size_t{mesh.genus()});
  // Every extremum is paired or essential.
  std::size_t tops = 0;
  for (const auto& extrema : m.diagram.essential_extrema) tops += extrema.top_is_cap ? 0 : 1;
  CHECK(m.diagram.finite_count + m.diagram.essential_extrema.size() + tops == points.minima + points.maxima);

  // The complex has the same critical points.
  CHECK(m.complex.minimum_count() == points.minima);
  CHECK(m.complex.saddle_count() == points.saddle_multiplicity);
  CHECK(m.complex.maximum_count() == points.maxima);
  CHECK(m.complex.arc_count() == 4 * points.saddle_multiplicity);
  CHECK(m.complex.quad_count() == 2 * points.saddle_multiplicity);
}

/// The result of a chain on a field of a mesh that was read from no file.
core::ScalarField apply(const tools::MethodChain& chain, const core::ScalarField& input) {
  return tools::apply_chain(chain, {input.mesh(), {}},
                            tools::Registry::standard().make_function("mean-curvature"), input)
      .field;
}

}  // namespace

TEST_CASE("invariants hold for every field that a method returns") {
  std::vector<tools::MethodChain> chains;
  for (const char* text : {"conventional",
                           "denoise:iterations=2",
                           "denoise:kind=laplacian,iterations=2",
                           "gaussian:sigma=0.6,iterations=2",
                           "laplacian:iterations=3",
                           "laplacian:scheme=implicit,iterations=2,time=0.3,weights=cotangent",
                           "saliency:scales=0.3/0.5",
                           "salient:iterations=2,sigma=0.6",
                           "salient:iterations=3,sigma=0.6,range=local",
                           "salient:iterations=2,sigma=0.6,classify=saliency",
                           "salient:iterations=2,sigma=0.6,weights=area,ball=connected",
                           "spectral:modes=2",
                           "fair:extrema=5",
                           "fair:extrema=9,values=input",
                           "spectral:modes=1+fair:extrema=4",
                           "tps:threshold=10%",
                           "tps:threshold=0",
                           "tps:threshold=1000%",
                           "tps:count=6",
                           "salient:iterations=1,sigma=0.6+tps:threshold=5%",
                           "tps:threshold=20%+salient:iterations=1,sigma=0.5"})
    chains.push_back(tools::Registry::standard().make_method(text));
  for (const tools::MethodEntry& entry : tools::Registry::standard().methods()) {
    INFO(entry.name << " belongs into the list above");
    CHECK(std::ranges::count(chains, entry.name, &tools::MethodChain::name) > 0);
  }
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 23))
      for (const tools::MethodChain& chain : chains) {
        INFO(entry.name << ", " << f.name << ", " << chain.specification);
        check_invariants(apply(chain, f.field));
      }
}

TEST_CASE("regression: compare, hierarchy and segment counted cells in three ways") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 29)) {
      INFO(entry.name << ", " << f.name);
      const auto field = std::make_shared<core::ScalarField>(f.field);
      const auto hierarchy = std::make_shared<mscomplex::PersistenceHierarchy>(*field);
      const mscomplex::Segmenter segmenter(*field, *hierarchy, mscomplex::SegmentKind::morse_smale);
      tools::Timings timings;
      const tools::Measurement m = tools::measure(*field, timings);
      CHECK(m.cells <= m.complex.quad_count() + entry.mesh.component_count());
      // At a boundary a cell may be several connected segments.
      const auto agree = [&](Index cells, Index segments) {
        return entry.mesh.is_closed() ? cells == segments : cells <= segments;
      };
      CHECK(agree(m.cells, segmenter.count(0)));
      std::vector<std::size_t> counts;
      for (const std::size_t share : {1u, 2u, 4u}) counts.push_back(m.critical_points.total() / share + 1);
      tools::build_levels(
          tools::levels_by_count({field, hierarchy}, counts),
          [&](const tools::Level& level) {
            CHECK(agree(level.quad_cells, segmenter.count(level.name.cancelled->cancellations)));
          },
          {});
    }
}

TEST_CASE("regression: shares of the extent were each method's own") {
  const TriangleMesh mesh = sphere(3).mesh();
  const core::LoadedMesh loaded{mesh, {}};
  struct Sink : tools::ComparisonSink {
    void field(const tools::FieldOutcome& outcome) override { extent = outcome.field.extent(); }
    void method(const tools::MethodOutcome& outcome) override {
      CHECK(outcome.input_extent == extent);
      ++methods;
    }
    double extent = 0;
    int methods = 0;
  } sink;
  tools::ComparisonRequest request;
  request.field = "height";
  request.methods = {"conventional", "spectral:modes=2", "saliency"};
  tools::run_comparison(loaded, tools::prepare(request), {&sink});
  CHECK(sink.methods == 3);
}

namespace {

/// Rows by specification: their critical points and the `count` of their last step, if it has one.
class Rows : public tools::ComparisonSink {
 public:
  struct Row {
    std::string specification;
    std::size_t total;
    std::optional<std::int64_t> count;
  };
  void field(const tools::FieldOutcome&) override {}
  void method(const tools::MethodOutcome& outcome) override {
    rows.push_back({outcome.specification, outcome.measurement.critical_points.total(), {}});
    for (const auto& [name, value] : outcome.steps.back().parameters)
      if (name == "count") rows.back().count = std::get<std::int64_t>(value);
  }
  std::vector<Row> rows;
};

std::vector<Rows::Row> rows_of(const tools::ComparisonRequest& request) {
  Rows sink;
  tools::run_comparison({jittered(sphere(3).mesh(), 0.02, 5), {}}, tools::prepare(request), {&sink});
  return sink.rows;
}

}  // namespace

TEST_CASE("by default tps is held to the number of points that salient leaves") {
  const std::vector<Rows::Row> rows = rows_of({});
  REQUIRE(rows.size() == 3);
  CHECK(rows[2].specification == "tps:count=salient");
  CHECK(rows[1].total < rows[0].total);
  REQUIRE(rows[2].count);
  CHECK(static_cast<std::size_t>(*rows[2].count) == rows[1].total);
  CHECK(rows[2].total <= rows[1].total);
  CHECK(rows[2].total + 1 >= rows[1].total);
}

TEST_CASE("a count is that of an earlier row, by its methods' names or by all of it") {
  const std::vector<Rows::Row> rows =
      rows_of({.field = "mean-curvature",
               .methods = {"laplacian:iterations=2", "laplacian:iterations=5",
                           "gaussian:sigma=1edges+tps:count=30", R"(tps:count=laplacian\:iterations\=5)",
                           R"(tps:count=gaussian\+tps+laplacian:iterations=0)"},
               .target = {}});
  REQUIRE(rows.size() == 5);
  CHECK(static_cast<std::size_t>(*rows[3].count) == rows[1].total);
  CHECK(rows[4].total + 1 >= rows[2].total);
  CHECK(rows[4].total <= rows[2].total);
  const auto refused = [](std::vector<std::string> methods, const char* why) {
    tools::ComparisonRequest request;
    request.methods = std::move(methods);
    CHECK_THROWS_AS(tools::prepare(request), core::InvalidArgument);
    CHECK_THROWS_WITH(tools::prepare(request), Catch::Contains(why));
  };
  refused({"tps:count=salient", "salient"}, "no method before it");
  refused({"conventional", "tps:count=salient"}, "before it there are conventional");
  refused({"salient:iterations=1", "salient:iterations=2", "tps:count=salient"}, "it could be");
  refused({"salient", "tps:count=salient,threshold=1%"}, "not both");
  CHECK_THROWS_WITH(tools::Registry::standard().make_method("tps:count=salient"),
                    Catch::Contains("in a comparison alone"));
}

TEST_CASE("regression: points that come from vertex numbers alone were not told from others") {
  const TriangleMesh mesh = sphere(2).mesh();
  const core::LoadedMesh loaded{mesh, {}};
  const auto warnings = [&](std::vector<double> values) {
    tools::Registry registry = tools::Registry::standard();
    struct Given final : core::MorseFunction {
      explicit Given(std::vector<double> v) : values(std::move(v)) {}
      core::FunctionResult evaluate(const TriangleMesh& on, const core::FunctionContext&) const override {
        return {{on, values}, {}};
      }
      std::vector<double> values;
    };
    registry.add(tools::FunctionEntry{
        "given", "values", [&](core::ParameterReader&) { return std::make_unique<Given>(values); }});
    return tools::evaluate_field(loaded, registry.make_function("given")).warnings;
  };
  const Index n = mesh.vertex_count();
  REQUIRE(warnings(std::vector<double>(n, 3)).size() == 1);
  CHECK_THAT(warnings(std::vector<double>(n, 3)).front(),
             Catch::Contains("constant") && Catch::Contains("vertex numbers alone"));
  REQUIRE(warnings(plateau_values(mesh, 2, 5)).size() == 1);
  CHECK_THAT(warnings(plateau_values(mesh, 2, 5)).front(), Catch::Contains("neighbour of the same value"));
  CHECK(warnings(random_values(n, 3)).empty());
  std::vector<double> one_tie = random_values(n, 3);
  one_tie[mesh.triangle(0)[0]] = one_tie[mesh.triangle(0)[1]];
  const std::vector<std::string> said = warnings(std::move(one_tie));
  CHECK(said.empty());
}

TEST_CASE("regression: salient on a coarse mesh did nothing, silently") {
  const core::ScalarField coarse(sphere(1).mesh(), random_values(42, 3));
  const auto warnings = [](const char* method, const core::ScalarField& input) {
    return tools::apply_chain(tools::Registry::standard().make_method(method), {input.mesh(), {}},
                              tools::Registry::standard().make_function("height"), input)
        .steps.front()
        .warnings;
  };
  for (const char* method : {"salient", "gaussian"}) {
    REQUIRE(warnings(method, coarse).size() == 1);
    CHECK_THAT(warnings(method, coarse).front(),
               Catch::Contains("of 42 vertices 42 have no other") && Catch::Contains("1edges"));
  }
  CHECK(warnings("salient:sigma=1edges", coarse).empty());
  const TriangleMesh fine = sphere(4).mesh();
  CHECK(warnings("salient", core::ScalarField(fine, random_values(fine.vertex_count(), 3))).empty());
}

TEST_CASE("regression: default lengths other than the paper's sigma changed as the mesh was turned") {
  const tools::Registry& registry = tools::Registry::standard();
  const TriangleMesh mesh = jittered(torus(30, 20).mesh(), 0.03, 5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Point(1, 2, -1).normalized()).toRotationMatrix();
  const TriangleMesh turned = moved(mesh, turn, {3, -2, 1});
  REQUIRE(turned.epsilon() != Approx(mesh.epsilon()).epsilon(1e-3));
  const auto same = [](const core::Parameters& a, const core::Parameters& b) {
    REQUIRE(a.size() == b.size());
    bool all = true;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (const double* x = std::get_if<double>(&a[i].second))
        all &= std::get<double>(b[i].second) == Approx(*x).epsilon(1e-6);
    return all;
  };
  for (const char* text :
       {"mean-curvature:estimator=quadric", "mean-curvature:estimator=diffused",
        "gaussian-curvature:estimator=quadric", "principal-curvature", "curvedness", "shape-index",
        "geodesic:source=3", "geodesic:mode=average", "heat-kernel-signature:modes=20"}) {
    INFO(text);
    const tools::NamedFunction named = registry.make_function(text);
    CHECK(
        same(named.function->evaluate(mesh, {}).parameters, named.function->evaluate(turned, {}).parameters));
  }
  const auto step = [&](const std::string& text, const TriangleMesh& on) {
    return tools::apply_chain(registry.make_method(text), {on, {}}, registry.make_function("mean-curvature"),
                              {on, random_values(on.vertex_count(), 3)})
        .steps.front();
  };
  for (const char* text : {"laplacian:scheme=implicit", "saliency", "denoise", "denoise:kind=laplacian"}) {
    INFO(text);
    CHECK(same(step(text, mesh).parameters, step(text, turned).parameters));
  }
  for (const char* text : {"salient", "gaussian"}) {
    CHECK(!same(step(text, mesh).parameters, step(text, turned).parameters));
    for (const char* unit : {"2edges", "0.05rootarea"}) {
      const std::string given = std::string(text) + ":sigma=" + unit;
      CHECK(same(step(given, mesh).parameters, step(given, turned).parameters));
    }
  }
  CHECK(tools::matching_radius(turned) == Approx(tools::matching_radius(mesh)).epsilon(1e-12));
}

TEST_CASE("every method gives the same bits at any number of threads") {
  const TriangleMesh mesh = torus(90, 80).mesh();
  const core::ScalarField input(mesh, smooth_values(mesh, 1, 3));
  for (const auto& entry : tools::Registry::standard().methods()) {
    INFO(entry.name);
    const tools::MethodChain chain = tools::Registry::standard().make_method(entry.name);
    const auto run = [&](int threads) {
      const core::ThreadLimit limit(threads);
      const core::ScalarField field = apply(chain, input);
      return std::pair{std::vector<double>(field.values().begin(), field.values().end()),
                       std::vector<Index>(field.ranks().begin(), field.ranks().end())};
    };
    const auto one = run(1);
    CHECK(run(2) == one);
    CHECK(run(7) == one);
  }
}

TEST_CASE("points are chosen of every row as of its field alone, and compared among themselves") {
  const core::LoadedMesh loaded{jittered(sphere(4).mesh(), 0.02, 4), {}};
  struct Sink : tools::ComparisonSink {
    std::vector<tools::MethodOutcome> rows;
    void field(const tools::FieldOutcome&) override {}
    void method(const tools::MethodOutcome& outcome) override { rows.push_back(outcome); }
  };
  tools::ComparisonRequest request;
  request.methods = {"conventional", "gaussian:sigma=0.2", "tps:count=12"};
  const auto run = [&] {
    Sink sink;
    run_comparison(loaded, prepare(request), {&sink});
    return std::move(sink.rows);
  };
  const std::vector<tools::MethodOutcome> without = run();
  request.points.emplace();
  request.points->count = 15;
  request.points->rank = morse::PointRank::salience;
  const std::vector<tools::MethodOutcome> with = run();
  request.snap = true;
  const std::vector<tools::MethodOutcome> snapped = run();
  const tools::PointsPlan plan = prepare(*request.points);
  for (std::size_t row = 0; row < with.size(); ++row) {
    INFO(with[row].specification);
    CHECK_FALSE(without[row].chosen);
    CHECK(&without[row].shown_points() == &without[row].measurement.critical_points);
    // Choosing changes nothing else.
    CHECK(with[row].measurement.critical_points.points == without[row].measurement.critical_points.points);
    CHECK(with[row].compared_to_first.kept.size() == without[row].compared_to_first.kept.size());

    REQUIRE(with[row].chosen);
    const tools::ChosenOutcome& chosen = *with[row].chosen;
    const tools::MadeField made =
        make_field(tools::prepare(tools::FieldRequest{"mean-curvature", request.methods[row], {}}), loaded);
    const tools::MadePoints alone = tools::PointMaker(plan, loaded).make(made.for_points());
    CHECK(chosen.made.places == alone.places);
    CHECK(chosen.made.note == alone.note);
    CHECK(chosen.points.total() == chosen.made.chosen.points.size());
    CHECK(std::ranges::is_sorted(chosen.points.points, {}, &morse::CriticalPoint::vertex));
    CHECK(&with[row].shown_points() == &chosen.points);
    const tools::Matching& matching = chosen.compared_to_first;
    CHECK(matching.kept.size() + matching.moved.size() + matching.added == chosen.points.total());
    if (row == 0) CHECK(matching.kept.size() == chosen.points.total());

    // At their origins, in the same order.
    const tools::MethodOutcome& moved = snapped[row];
    REQUIRE(moved.chosen->made.places.size() == chosen.made.places.size());
    const auto& all = moved.measurement.critical_points.points;
    for (std::size_t i = 0; i < chosen.made.places.size(); ++i) {
      const auto at = std::ranges::lower_bound(all, chosen.made.places[i], {}, &morse::CriticalPoint::vertex);
      const Index origin = moved.origins[static_cast<std::size_t>(at - all.begin())];
      CHECK(moved.chosen->made.places[i] == (origin == core::kNone ? chosen.made.places[i] : origin));
    }
  }
  request.points->count = 0;
  CHECK_THROWS_AS(prepare(request), core::InvalidArgument);
}

TEST_CASE("pairs above 1 % of the range are those of the summary, infinite ones included") {
  struct Last : tools::ComparisonSink {
    void field(const tools::FieldOutcome& outcome) override { extent = outcome.field.extent(); }
    void method(const tools::MethodOutcome& outcome) override {
      const double least = 0.01 * extent;
      for (const auto& pair : outcome.measurement.diagram.pairs) large += pair.persistence() > least ? 1 : 0;
      summary = tools::summary_of(outcome.measurement.diagram, extent);
      own = tools::summary_of(outcome.measurement.diagram, outcome.field.extent());
    }
    double extent = 0;  // of the input
    std::size_t large = 0;
    tools::PersistenceSummary own;
    tools::PersistenceSummary summary;
  };
  const TriangleMesh mesh = grid(12, 12).mesh();
  Last last;
  tools::ComparisonTable table;
  tools::ComparisonRequest request;
  request.methods = {"gaussian:sigma=2edges"};  // which narrows the range
  tools::run_comparison({jittered(mesh, 0.2, 5), {}}, tools::prepare(request), {&last, &table});
  CHECK(last.large > 0);
  CHECK(last.own.above_one_percent() > last.large);
  CHECK(last.summary.above_one_percent() == last.large);
  std::istringstream lines(table.text());
  std::string line;
  while (!line.starts_with("gaussian:sigma=2edges") && std::getline(lines, line)) {
  }
  std::istringstream row(line);
  std::vector<std::string> cells(8);
  for (std::string& cell : cells) row >> cell;
  CHECK(cells[7] == std::to_string(last.large));
}
