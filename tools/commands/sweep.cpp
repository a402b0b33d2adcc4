// morsel sweep: a field and a method with every combination of some parameters' values.

#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/commands/table_target.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/plot/plot_files.h"
#include "morsel/tools/plot/sweep_plots.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/row_journal.h"
#include "morsel/tools/report/sweep_writer.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  SweepRequest request;
  std::string output;
  std::string figure_folder;
};

std::vector<std::string> fields_of(const SweepPlan& prepared) {
  std::set<std::string> fields;
  for (const Combination& combination : prepared.combinations) fields.insert(to_string(combination.field));
  return {fields.begin(), fields.end()};
}

std::vector<plot::NamedPlot> plots_of(const SweepReport& report) {
  std::vector<plot::NamedPlot> plots;
  for (std::size_t k = 0; k < report.plan.variations.size(); ++k)
    if (std::optional<plot::Plot> plot = plot::sweep_plot(report.plan, report.rows, k))
      plots.emplace_back(report.plan.variations[k].key, std::move(*plot));
  return plots;
}

int sweep(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  if (!options.figure_folder.empty()) drawing::require_pictures("--figures");
  const SweepPlan prepared = prepare(options.request);
  RunFiles named;
  named.reads("MESH", options.mesh);
  for (const std::string& field : fields_of(prepared)) named.reads_of_field(field);
  write_table(named, options.output).fills("--figures", options.figure_folder).check();
  std::optional<ResultFolder> figures;
  if (!options.figure_folder.empty())
    figures.emplace(options.figure_folder, ResultFolder::Options{named.outputs(), console.stop_token()});
  TableTarget target(options.output);

  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, console.progress());
  const ReportInput about{options.mesh, input.sha256, common.repair, true, load_watch.seconds()};
  const std::vector<HashedFile> files = input_files(fields_of(prepared));
  std::optional<RowJournal> done;
  if (Journal* journal = target.open_journal(rows_key(about, files))) {
    done.emplace(*journal, prepared, files);
    for (const std::string& warning : journal->warnings()) console.warning(warning);
  }
  if (done && done->count() > 0)
    console.message("going on with " + std::to_string(done->count()) + " of " +
                    std::to_string(prepared.combinations.size()) + " combinations done: " + options.output +
                    ".journal");
  const std::vector<SweepRow> rows =
      run_sweep(input.loaded, prepared, done ? done->options() : SweepOptions(), console.progress());

  std::set<std::string> warnings;  // a field is in many rows
  for (const SweepRow& row : rows)
    for (const std::string& warning : row.field.warnings) warnings.insert(row.field.name + ": " + warning);
  for (const std::string& warning : warnings) console.warning(warning);

  const SweepReport report{input.loaded, about, options.request, prepared, rows, files};
  target.write([&](JsonSink& json) { write_sweep(json, report); },
               [&](std::ostream& out) { write_sweep_csv(out, report); });
  if (figures) {
    std::vector<HashedFile> inputs = {{options.mesh, input.sha256}};
    inputs.insert(inputs.end(), files.begin(), files.end());
    plot::write_plots(
        *figures, plots_of(report),
        Provenance(common.command, request_section(options.request, prepared, common.repair), inputs));
  }
  if (!target.is_stdout()) std::cout << sweep_table(report);
  if (target.is_file()) console.message("sweep: " + options.output);
  if (!options.figure_folder.empty()) console.message("plots: " + options.figure_folder);
  return kDone;
}

}  // namespace

void add_sweep(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "sweep", "How the numbers of critical points depend on parameters: every combination of their values");
  command.path("MESH", options->mesh, mesh_help()).required();
  command.text("--field", options->request.field, "Morse function").value("F");
  command.text("--method", options->request.method, "A method or chain of methods").value("M");
  command
      .texts("--vary", options->request.vary,
             "A parameter and its values, separated by commas; may be given several times. A..B stands for "
             "A, A + 1 and so on to B; A..B..S goes by S, A..B..xF by the factor F; numbers may have a unit "
             "(2eps..16eps..x2). KEY is one of the method or of the field; where several have it, it is "
             "field.KEY, NAME.KEY or, with the number of the step, 2.KEY")
      .value("KEY=VALUES")
      .required();
  command
      .path("-o,--output", options->output,
            "Write a row for each combination (.json or .csv) here; - is JSON on standard output. "
            "Should it be interrupted, OUT.journal holds what is done, and the same command goes on "
            "from there")
      .value("OUT");
  command
      .path("--figures", options->figure_folder,
            "Write a plot of critical points against each varied parameter (.svg and .png) here")
      .value("DIR");
  add_common_options(command, program.common);
  command.examples = {
      {"sweep scan.off --method salient --vary iterations=1..10", "the counts after each iteration"},
      {"sweep scan.off --method salient --vary sigma=2eps..16eps..x2 --vary range=0.5std,1std -o grid.csv",
       "a table of eight combinations"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) { return sweep(*options, program.common, console); };
}

}  // namespace morsel::tools
