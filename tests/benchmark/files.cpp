// The share of reading and writing in the program's time.

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmark/suites.h"
#include "benchmark/workloads.h"

namespace morsel::benchmark {

void run_files(const Plan& plan, const Report& report) {
  const Workload work = workload("bunny00", plan.quick ? 1 : 4);
  for (const std::string extension : {"off", "obj", "ply"}) {
    const std::string path = write_mesh(work.mesh, plan.scratch, extension);
    const std::string json = plan.scratch + "/report.json";
    const ProcessCost cost = measured_process(
        {plan.program, "compare", path, "-o", json, "--export", plan.scratch + "/export", "--quiet"});
    // The report counts the time of computing; the rest of the wall time is files: the mesh, its hash,
    // report, export.
    const auto timings = nlohmann::json::parse(std::ifstream(json)).at("timings");
    double computing = timings.at("field").get<double>();
    for (const auto& method : timings.at("methods"))
      for (const auto& [step, seconds] : method.items())
        if (seconds.is_number()) computing += seconds.get<double>();
    Row row;
    row.step = "compare " + extension;
    row.mesh = work.mesh_name;
    row.vertices = work.mesh.vertex_count();
    row.field = "mean-curvature";
    row.threads = plan.threads.back();
    row.cost = {cost.seconds, cost.seconds, 1, cost.peak};
    char text[120];
    std::snprintf(text, sizeof(text), "files %.1f %%: %.2f s, of which reading %.2f s",
                  100 * (1 - computing / cost.seconds), cost.seconds - computing,
                  timings.at("load").get<double>());
    row.note = text;
    report(row);
    std::filesystem::remove(path);
  }
}

}  // namespace morsel::benchmark
