#include <stdexcept>

#include "benchmark/suites.h"
#include "benchmark/workloads.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/hierarchy.h"
#include "morsel/mscomplex/hierarchy_cursor.h"
#include "support/greedy_hierarchy.h"

namespace morsel::benchmark {
namespace {

struct Structure {
  std::string name;
  std::function<std::size_t()> run;
  std::vector<Baseline> baselines = {};
};

std::vector<Structure> structures(const core::ScalarField& field, const mscomplex::MorseSmaleComplex& complex,
                                  const mscomplex::PersistenceHierarchy& hierarchy, double greedy_seconds) {
  const core::Index half = hierarchy.levels() / 2;
  return {{"hierarchy",
           [&] { return std::size_t{mscomplex::PersistenceHierarchy(field, complex).levels()}; },
           {{"greedy", greedy_seconds}}},
          {"walk to the last level and back",
           [&] {
             mscomplex::HierarchyCursor cursor(hierarchy);
             cursor.go_to(hierarchy.levels());
             cursor.go_to(0);
             return std::size_t{cursor.level()};
           }},
          {"gradient of the middle level", [&, half] { return hierarchy.gradient(half).saddles().size(); }},
          {"gradient of the last level",
           [&] { return hierarchy.gradient(hierarchy.levels()).saddles().size(); }}};
}

}  // namespace

void run_structures(const Plan& plan, const Report& report) {
  const Workload work = workload("refined_elephant", plan.quick ? 1 : 5);
  for (const std::string name : {"height", "mean-curvature"}) {
    const core::ScalarField field = field_of(work.mesh, name);
    const mscomplex::MorseSmaleComplex complex(field);
    const mscomplex::PersistenceHierarchy hierarchy(field, complex);
    const Stopwatch watch;
    const std::size_t greedy = test::cancel_greedily(complex).size();
    const double greedy_seconds = watch.seconds();
    if (greedy != hierarchy.levels()) throw std::runtime_error("greedy cancellation finds something else");
    for (const int threads : plan.threads) {
      const core::ThreadLimit limit(threads);
      for (const Structure& structure : structures(field, complex, hierarchy, greedy_seconds)) {
        Row row;
        row.step = structure.name;
        row.mesh = work.mesh_name;
        row.vertices = work.mesh.vertex_count();
        row.field = name;
        row.threads = threads;
        row.cost = measured(structure.run);
        row.baselines = structure.baselines;
        row.note = std::to_string(hierarchy.levels()) + " cancellations";
        report(row);
      }
    }
  }
}

}  // namespace morsel::benchmark
