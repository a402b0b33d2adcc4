// morsel sweep: a field and a method with every combination of some parameters' values.

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/commands/steps.h"
#include "morsel/tools/commands/table_target.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/plot/plot_files.h"
#include "morsel/tools/plot/sweep_plots.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/row_journal.h"
#include "morsel/tools/report/sweep_writer.h"

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

std::vector<NamedFunction> functions_of(const SweepPlan& prepared) {
  std::vector<NamedFunction> functions;
  for (const std::string& field : fields_of(prepared))
    functions.push_back(prepared.registry.make_function(field));
  return functions;
}

std::vector<plot::NamedPlot> plots_of(const SweepReport& report) {
  std::vector<plot::NamedPlot> plots;
  for (std::size_t k = 0; k < report.plan.variations.size(); ++k)
    if (std::optional<plot::Plot> plot = plot::sweep_plot(report.plan, report.rows, k))
      plots.emplace_back(report.plan.variations[k].key, std::move(*plot));
  return plots;
}

int sweep(const Options& options, const Run& run) {
  if (!options.figure_folder.empty()) drawing::require_pictures("--figures");
  const SweepPlan prepared = prepare(options.request);
  RunFiles named;
  named.reads_mesh(options.mesh, run.common.format).reads_mask(run.common.build);
  for (const std::string& field : fields_of(prepared)) named.reads_of_field(field);
  const core::FileTarget output = output_target(options.output, run);
  write_table(named, output).fills("--figures", options.figure_folder).check();
  const std::unique_ptr<ResultFolder> figures = open_folder(options.figure_folder, named, run);
  TableTarget target(output);

  const MeshInput input = read_input(options.mesh, functions_of(prepared), run);
  const std::vector<HashedFile> files = input_files(fields_of(prepared), prepared.registry);
  std::optional<RowJournal> done;
  if (Journal* journal = target.open_journal(rows_key(input.about, files)))
    done.emplace(*journal, prepared, files);
  target.tell_journal(done ? done->count() : 0,
                      " of " + std::to_string(prepared.combinations.size()) + " combinations done",
                      run.console);
  const std::vector<SweepRow> rows =
      run_sweep(input.loaded, prepared, done ? done->options() : SweepOptions(), run.console.progress());

  std::set<std::string> warnings;  // a field is in many rows
  for (const SweepRow& row : rows)
    for (const std::string& warning : row.field.warnings) warnings.insert(row.field.name + ": " + warning);
  for (const std::string& warning : warnings) run.console.warning(warning);

  const SweepReport report{input.loaded, input.about, options.request, prepared, rows, files};
  target.write([&](JsonSink& json) { write_sweep(json, report); },
               [&](std::ostream& out) { write_sweep_csv(out, report); });
  if (figures) {
    std::vector<HashedFile> inputs = {input.file()};
    inputs.insert(inputs.end(), files.begin(), files.end());
    const Json request = request_section(options.request, prepared, run.common.build);
    plot::write_plots(*figures, plots_of(report), Provenance(run.common.command, request, inputs));
  }
  show(sweep_table(report), run);
  target.tell("sweep", run);
  if (figures) run.console.message("plots: " + options.figure_folder);
  return kDone;
}

}  // namespace

void add_sweep(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "sweep", "How the numbers of critical points depend on parameters: every combination of their values");
  command.path("MESH", options->mesh, mesh_help()).required();
  command.text("--field", options->request.field, "Morse function").is_function();
  command.text("--method", options->request.method, "A method or chain of methods").is_method();
  command
      .texts("--vary", options->request.vary,
             "A parameter and its values: LIST, A..B or A..B..STEP; repeatable")
      .value("KEY=VALUES")
      .required()
      .in_detail(
          "A list is separated by commas. A..B stands for A, A + 1 and so on to B; A..B..S goes by S, "
          "A..B..xF by the factor F; numbers may have a unit (2eps..16eps..x2). KEY is one of the method or "
          "of the field; where several have it, it is field.KEY, NAME.KEY or, with the number of the step, "
          "2.KEY");
  add_table_option(command, options->output,
                   "Write a row a combination (.json or .csv) here; - is standard output")
      .in_detail(
          "Should it be interrupted, OUT.journal holds what is done, and the same command goes on from "
          "there");
  command
      .path("--figures", options->figure_folder,
            "Write plots of counts against each parameter (.svg, .png) here")
      .value("DIR")
      .shapes_nothing();
  add_common_options(command, program.common);
  command.examples = {
      {"sweep scan.off --method salient --vary iterations=1..10", "the counts after each iteration"},
      {"sweep scan.off --method salient --vary sigma=2eps..16eps..x2 --vary range=0.5std,1std -o grid.csv",
       "a table of eight combinations"}};
  add_specification_notes(command);
  set_action(program, command, options, sweep);
}

}  // namespace morsel::tools
