#include "morsel/tools/study/comparison.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <sstream>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/report/comparison_table.h"
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

TEST_CASE("pairs above 1 % of the range are those of the summary, infinite ones included") {
  struct Last : tools::ComparisonSink {
    void field(const tools::FieldOutcome&) override {}
    void method(const tools::MethodOutcome& outcome) override {
      const double least = 0.01 * outcome.field.extent();
      for (const auto& pair : outcome.measurement.diagram.pairs) large += pair.persistence() > least ? 1 : 0;
      summary = tools::summary_of(outcome.measurement.diagram, outcome.field.extent());
    }
    std::size_t large = 0;
    tools::PersistenceSummary summary;
  };
  const TriangleMesh mesh = grid(12, 12).mesh();
  Last last;
  tools::ComparisonTable table;
  tools::ComparisonRequest request;
  request.methods = {"tps:count=9"};
  tools::run_comparison({jittered(mesh, 0.2, 5), {}}, tools::prepare(request), {&last, &table});
  CHECK(last.large > 0);
  CHECK(last.summary.above_one_percent() == last.large);
  std::istringstream lines(table.text());
  std::string line;
  for (int number = 0; number < 4; ++number) std::getline(lines, line);  // headline, head, rule, row
  std::istringstream row(line);
  std::vector<std::string> cells(8);
  for (std::string& cell : cells) row >> cell;
  CHECK(cells[0] == "tps:count=9");
  CHECK(cells[7] == std::to_string(last.large));
}
