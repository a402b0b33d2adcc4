// Time and memory per vertex by mesh size.

#include <filesystem>

#include "benchmark/steps.h"
#include "benchmark/suites.h"
#include "benchmark/workloads.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::benchmark {

void run_scaling(const Plan& plan, const Report& report) {
  const int threads = plan.threads.back();
  const core::ThreadLimit limit(threads);
  // elephant has 2,775 vertices: 11 thousand to 5.1 million.
  for (const int pieces : plan.quick ? std::vector{2, 4} : std::vector{2, 4, 9, 20, 43}) {
    const Workload work = workload("elephant", pieces);
    Row row;
    row.mesh = work.mesh_name;
    row.vertices = work.mesh.vertex_count();
    row.field = "mean-curvature";
    row.threads = threads;
    {
      row.step = "mean curvature";
      row.cost = measured([&] { return field_of(work.mesh, "mean-curvature").max(); }, 1);
      report(row);
      const core::ScalarField field = field_of(work.mesh, "mean-curvature");
      for (const Step& step : steps(work.mesh, field)) {
        row.step = step.name;
        row.cost = measured(step.run, 1, 1, step.prepare);
        report(row);
      }
    }
    const std::string path = write_mesh(work.mesh, plan.scratch, "ply");
    const ProcessCost cost =
        measured_process({plan.program, "compare", path, "--method", "conventional", "--method", "tps", "-o",
                          plan.scratch + "/report.json", "--no-items", "--quiet"});
    row.step = "whole program";
    row.cost = {cost.seconds, cost.seconds, 1, cost.peak};
    report(row);
    std::filesystem::remove(path);
  }
}

}  // namespace morsel::benchmark
