// Every Morse function and method beside the same made with stock libraries.

#include <functional>
#include <map>

#include "benchmark/stock.h"
#include "benchmark/suites.h"
#include "benchmark/workloads.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::benchmark {
namespace {

using Baselines = std::map<std::string, std::pair<std::string, std::function<double()>>>;

/// By the text of the function or method.
Baselines baselines(const core::TriangleMesh& mesh, const core::ScalarField& field) {
  const double epsilon = mesh.epsilon();
  return {{"geodesic:source=0", {"Eigen", [&] { return stock::geodesic(mesh, 0); }}},
          {"eigenfunction:index=10", {"Spectra", [&] { return stock::eigenfunctions(mesh, 10); }}},
          {"mean-curvature:estimator=quadric,radius=4eps",
           {"Eigen", [&, epsilon] { return stock::quadric_curvature(mesh, 4 * epsilon); }}},
          {"laplacian", {"Eigen", [&] { return stock::laplacian(mesh, field.values()); }}},
          {"laplacian:scheme=implicit,weights=cotangent",
           {"Eigen",
            [&, epsilon] { return stock::implicit_laplacian(mesh, field.values(), 2 * epsilon * epsilon); }}},
          {"gaussian:sigma=8eps",
           {"nanoflann", [&, epsilon] { return stock::gaussian(mesh, field.values(), 8 * epsilon); }}}};
}

}  // namespace

void run_methods(const Plan& plan, const Report& report) {
  const Workload work = workload("bunny00", plan.quick ? 1 : 2);
  const core::LoadedMesh loaded{work.mesh, {}};
  const tools::NamedFunction curvature = tools::Registry::standard().make_function("mean-curvature");
  const core::ScalarField field = tools::evaluate_field(loaded, curvature).field;
  std::map<std::string, double> stock_seconds;
  const Baselines stock_runs = baselines(work.mesh, field);
  const auto add = [&](const std::string& what, const auto& run) {
    const auto baseline = stock_runs.find(what);
    if (baseline != stock_runs.end() && !stock_seconds.contains(what))
      stock_seconds[what] = measured(baseline->second.second, 1, 0).seconds;
    for (const int threads : plan.threads) {
      const core::ThreadLimit limit(threads);
      Row row;
      row.step = what;
      row.mesh = work.mesh_name;
      row.vertices = work.mesh.vertex_count();
      row.threads = threads;
      row.cost = measured(run, 1, 1);
      if (baseline != stock_runs.end())
        row.baselines.push_back({baseline->second.first, stock_seconds.at(what)});
      report(row);
    }
  };
  for (const char* text :
       {"mean-curvature", "mean-curvature:estimator=cotangent",
        "mean-curvature:estimator=quadric,radius=4eps", "gaussian-curvature", "principal-curvature",
        "curvedness", "shape-index", "geodesic:source=0", "geodesic:mode=average", "eigenfunction:index=10",
        "gaussian-curvature:estimator=diffused", "heat-kernel-signature"}) {
    const tools::NamedFunction function = tools::Registry::standard().make_function(text);
    add(text, [&] { return tools::evaluate_field(loaded, function).field; });
  }
  for (const char* text :
       {"salient", "gaussian:sigma=8eps", "saliency", "laplacian",
        "laplacian:scheme=implicit,weights=cotangent", "fair", "denoise", "denoise:kind=laplacian",
        "spectral:modes=10", "salient:weights=area", "salient:ball=connected", "tps"}) {
    const tools::MethodChain chain = tools::Registry::standard().make_method(text);
    add(text, [&] { return tools::apply_chain(chain, loaded, curvature, field).field; });
  }
}

}  // namespace morsel::benchmark
