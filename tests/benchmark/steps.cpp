#include <memory>
#include <stdexcept>

#include "benchmark/plain.h"
#include "benchmark/published.h"
#include "benchmark/steps.h"
#include "benchmark/suites.h"
#include "benchmark/workloads.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/pairing.h"

namespace morsel::benchmark {
namespace {

/// The geometry of all arcs, each walked from end to end; the sum of their lengths, so that nothing is left
/// out.
std::size_t trace_all(const mscomplex::MorseSmaleComplex& complex) {
  std::vector<std::size_t> length(complex.arc_count());
  core::parallel_for(0, complex.arc_count(), 1024, [&](std::size_t first, std::size_t last) {
    std::vector<core::Index> cells;
    for (std::size_t arc = first; arc < last; ++arc) {
      complex.trace_cells(static_cast<core::Index>(arc), cells);
      length[arc] = cells.size();
    }
  });
  std::size_t sum = 0;
  for (const std::size_t l : length) sum += l;
  return sum;
}

}  // namespace

std::vector<Step> steps(const core::TriangleMesh& mesh, const core::ScalarField& field) {
  // Bytes that cannot be avoided, per vertex of a closed mesh: 24 for positions, 8 for values, 4 for ranks or
  // order, 24 for triangles (two a vertex), 4 or 8 for a label or number per vertex or triangle.
  const auto n = static_cast<double>(mesh.vertex_count());
  struct Input {
    std::vector<core::Point> positions;
    std::vector<core::Triangle> triangles;
    std::vector<double> values;
  };
  const auto input = std::make_shared<Input>();
  return {{"build mesh", 24 * n + (24 + 24 + 12 + 4) * n,
           [input] {
             return core::TriangleMesh(std::move(input->positions), std::move(input->triangles)).edge_count();
           },
           [input, &mesh] {
             input->positions.assign(mesh.positions().begin(), mesh.positions().end());
             input->triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
           }},
          {"order", (8 + 4 + 4) * n,
           [input, &mesh] { return core::ScalarField(mesh, std::move(input->values)).order()[0]; },
           [input, &field] { input->values.assign(field.values().begin(), field.values().end()); }},
          {"critical points", (24 + 4) * n, [&field] { return morse::classify(field).total(); }},
          {"diagram", (24 + 4 + 8) * n, [&field] { return persistence::pair_extrema(field).pairs.size(); }},
          {"cancel 1 %", (24 + 4 + 8) * n + (8 + 4 + 4) * n,
           [&field] {
             return persistence::cancel(field, {.threshold = persistence::Threshold::percent(1), .count = {}})
                 .cancelled_pairs;
           }},
          {"gradient", (24 + 4) * n + (4 + 2) * n,
           [&field] { return mscomplex::DiscreteGradient(field).saddles().size(); }},
          {"complex", (24 + 4) * n + (4 + 2) * n + 3 * (4 + 8) * n, [&field] {
             const mscomplex::MorseSmaleComplex complex(field);
             return trace_all(complex) + mscomplex::segment(field, complex.gradient()).morse_smale.count;
           }}};
}

void run_steps(const Plan& plan, double machine_factor, const Report& report) {
  const Workload work = workload("refined_elephant", plan.quick ? 1 : 5);
  for (const std::string name : {"height", "mean-curvature"}) {
    const core::ScalarField field = field_of(work.mesh, name);
    // The plain versions run once, on one thread, and must agree.
    std::vector<std::pair<std::string, double>> plain_seconds;
    const auto run_plain = [&](const std::string& step, std::size_t expected, const auto& run) {
      const Stopwatch watch;
      const std::size_t result = run();
      plain_seconds.emplace_back(step, watch.seconds());
      if (result != expected)
        throw std::runtime_error("the plain version of '" + step + "' finds something else");
    };
    run_plain("build mesh", work.mesh.edge_count(), [&] { return plain::edges(work.mesh.triangles()); });
    run_plain("order", field.order()[0], [&] { return plain::order(field.values())[0]; });
    run_plain("critical points", morse::classify(field).total(),
              [&] { return plain::critical_points(work.mesh, field.ranks()); });
    run_plain("diagram", persistence::pair_extrema(field).pairs.size(),
              [&] { return plain::pairs(work.mesh, field.ranks()); });
    for (const int threads : plan.threads) {
      const core::ThreadLimit limit(threads);
      for (const Step& step : steps(work.mesh, field)) {
        Row row;
        row.step = step.name;
        row.mesh = work.mesh_name;
        row.vertices = work.mesh.vertex_count();
        row.field = name;
        row.threads = threads;
        row.bytes_moved = step.bytes_moved;
        row.cost = measured(step.run, 3, 1, step.prepare);
        for (const auto& [plain_step, seconds] : plain_seconds)
          if (plain_step == step.name) row.baselines.push_back({"plain", seconds});
        if (const auto seconds = plan.quick ? std::nullopt : ttk_seconds(step.name, name, threads))
          row.baselines.push_back({"TTK (scaled)", *seconds * machine_factor});
        report(row);
      }
    }
  }
}

void run_memory(const Plan& plan, const Report& report) {
  const Workload work = workload("refined_elephant", plan.quick ? 1 : 5);
  const std::string path = write_mesh(work.mesh, plan.scratch, "ply");
  for (const std::string name : {"height", "mean-curvature"}) {
    const ProcessCost cost = measured_process({plan.program, "compare", path, "--field", name, "--method",
                                               "conventional", "--method", "tps:threshold=1%", "--quiet"});
    Row row;
    row.step = "whole program";
    row.mesh = work.mesh_name;
    row.vertices = work.mesh.vertex_count();
    row.field = name;
    row.threads = static_cast<int>(plan.threads.back());
    row.cost = {cost.seconds, cost.seconds, 1, cost.peak};
    row.note = "compare with conventional and tps";
    char text[60];
    std::snprintf(text, sizeof(text), "; TTK's peak: %.0f MB, %.1f times", 1e-6 * ttk_peak_bytes(name),
                  ttk_peak_bytes(name) / static_cast<double>(cost.peak));
    if (!plan.quick) row.note += text;
    report(row);
  }
}

}  // namespace morsel::benchmark
