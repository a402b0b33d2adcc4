// morsel check: a report is its own regression test.

#include <iostream>
#include <memory>

#include "morsel/core/error.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/report/difference.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/report_reader.h"
#include "morsel/tools/report/report_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string report;
  bool all = false;
};

/// The report that the same request gives now.
ReportDocument run_again(const LoadedReport& report, const std::filesystem::path& mesh_path,
                         const core::Progress& progress) {
  const HashedMesh input = read_hashed_mesh(mesh_path, {.repair = report.repair}, progress);
  ReportCollector again;
  ReportWriter writer(again, input.loaded, {report.mesh_path, input.sha256, report.repair, report.items},
                      report.request);
  run_comparison(input.loaded, prepare(report.request), {&writer}, progress);
  writer.finish();
  return again.take();
}

void print_differences(const std::vector<Difference>& differences, bool all) {
  constexpr std::size_t kShown = 20;
  const std::size_t shown = all ? differences.size() : std::min(kShown, differences.size());
  for (std::size_t i = 0; i < shown; ++i)
    std::cout << "  " << differences[i].where << ": " << differences[i].before << " -> "
              << differences[i].after << '\n';
  if (shown < differences.size())
    std::cout << "  … and " << differences.size() - shown << " more (--all shows them)\n";
}

int check(const Options& options, Console& console) {
  const LoadedReport report = read_report(options.report);
  const std::filesystem::path mesh = find_mesh(report, options.report);
  if (mesh.empty()) {
    std::cout << options.report << ": the mesh " << report.mesh_path << " is missing\n";
    return kDifferences;
  }
  ReportDocument again;
  try {
    again = run_again(report, mesh, console.progress());
  } catch (const core::InvalidArgument& error) {
    throw core::BadInput(options.report + " asks for what this version does not do: " + error.what());
  }
  const std::vector<Difference> differences = report_differences(report.document, again);
  if (differences.empty()) {
    std::cout << options.report << ": unchanged (" << report.request.methods.size() << " method"
              << (report.request.methods.size() == 1 ? "" : "s") << " on " << report.mesh_path << ")\n";
    return kDone;
  }
  std::cout << options.report << ": " << differences.size() << " difference"
            << (differences.size() == 1 ? "" : "s") << " (report -> now)\n";
  print_differences(differences, options.all);
  return kDifferences;
}

}  // namespace

void add_check(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("check", "Run a report's comparison again and show what changed");
  command.add_option("REPORT", options->report, "A report of morsel compare")->required();
  command.add_flag("--all", options->all, "Show every difference, not only the first 20");
  add_common_options(command, invocation.common, false);
  command.footer(
      "The mesh is looked for from the working folder, then from the report's folder. Timings and the "
      "program's\n"
      "version may differ; counts and texts may not, real numbers by no more than 1e-9 of themselves.");
  command.callback([options, &invocation] {
    invocation.action = [options](Console& console) { return check(*options, console); };
  });
}

}  // namespace morsel::tools
