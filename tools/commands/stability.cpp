// morsel stability: how well critical points repeat on perturbed surfaces.

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/commands/steps.h"
#include "morsel/tools/commands/table_target.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/plot/plot_files.h"
#include "morsel/tools/plot/stability_plots.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/stability_table.h"
#include "morsel/tools/report/stability_writer.h"
#include "morsel/tools/report/trial_journal.h"
#include "morsel/tools/study/presets.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  StabilityRequest request;
  std::string output;
  std::string figure_folder;
};

std::vector<plot::NamedPlot> plots_of(const StabilityReport& report) {
  std::vector<plot::NamedPlot> plots;
  if (std::optional<plot::Plot> plot = plot::noise_plot(report.plan, report.result))
    plots.emplace_back("noise", std::move(*plot));
  if (std::optional<plot::Plot> plot = plot::vertices_plot(report.plan, report.result, report.loaded.mesh))
    plots.emplace_back("vertices", std::move(*plot));
  return plots;
}

int measure_stability(const Options& options, const Run& run) {
  if (!options.figure_folder.empty()) drawing::require_pictures("--figures");
  const StabilityPlan prepared = prepare(options.request);
  const StabilityRequest request = with_defaults(options.request);
  RunFiles files;
  files.reads_mesh(options.mesh, run.common.format).reads_mask(run.common.build);
  for (const std::string& field : request.fields) files.reads_of_field(field);
  if (!request.reference_field.empty()) files.reads_of_field(request.reference_field, "--reference-field");
  const core::FileTarget output = output_target(options.output, run);
  write_table(files, output).fills("--figures", options.figure_folder).check();
  const std::unique_ptr<ResultFolder> figures = open_folder(options.figure_folder, files, run);
  TableTarget target(output);

  const MeshInput input = read_input(options.mesh, prepared.functions, run);
  std::optional<TrialJournal> trials;
  if (Journal* journal = target.open_journal(trials_key(request, input.about)))
    trials.emplace(*journal, prepared.targets.size() * prepared.functions.size() * prepared.chains.size());
  target.tell_journal(trials ? trials->count() : 0, " perturbed surfaces done", run.console);
  const StabilityResult result =
      run_stability(input.loaded, prepared, run.console.progress(), trials ? &*trials : nullptr);
  for (const FieldOutcome& field : result.fields) tell_warnings(field, run.console);
  for (const std::string& warning : result.warnings()) run.console.warning(warning);
  for (std::size_t i = 0; i < result.outcomes.size() / prepared.targets.size(); ++i)  // the first target's
    tell_warnings(result.outcomes[i].clean.steps, run.console);

  const StabilityReport report{input.loaded, input.about, request, prepared, result};
  target.write([&](JsonSink& json) { write_stability(json, report); },
               [&](std::ostream& out) { write_stability_csv(out, report); });
  if (figures) {
    std::vector<HashedFile> inputs = {input.file()};
    for (HashedFile& file : input_files(request)) inputs.push_back(std::move(file));
    plot::write_plots(*figures, plots_of(report),
                      Provenance(run.common.command, request_section(request, run.common.build), inputs));
  }
  show(stability_table(prepared, result), run);
  target.tell("stability", run);
  if (figures) run.console.message("plots: " + options.figure_folder);
  return kDone;
}

void add_perturbation_options(Command& command, StabilityRequest& request) {
  command.begin_group("How the surface is perturbed");
  command.numbers("--noise", request.noise, "Standard deviations of Gaussian noise, in mean edge lengths")
      .value("S,S,...")
      .in_detail("By default, if no perturbation is given: 0.05,0.15,0.3,0.5");
  command.choice("--kind", request.noise_kind, {NoiseKind::normal, NoiseKind::isotropic},
                 "Noise along normals (normal) or in x, y and z (isotropic)");
  command.numbers("--decimate", request.decimate, "Shares of the vertices that are left after decimation")
      .value("R,R,...")
      .in_detail("Edges are collapsed, short ones first");
  command.numbers("--subdivide", request.subdivide, "Numbers of equal pieces that every edge is cut into")
      .in_detail("The surface stays the same");
  command.number("--trials", request.trials, "Trials of each random perturbation").between(1, 1'000'000);
  command.number("--seed", request.seed,
                 "Seed of the random numbers; a trial depends on it and on its number");
}

void add_agreement_options(Command& command, StabilityRequest& request) {
  command.begin_group("What counts as the same point");
  command.text("--radius", request.radius, "Points match within this length")
      .value("R")
      .in_detail("On the clean surface; 2% is of the diagonal of its bounding box");
  command.choice("--points", request.points, {PointChoice::all, PointChoice::extrema},
                 "Which points are compared: all or extrema");
  command.text("--reference", request.reference, "Agreement is the share of points that this method has, too")
      .is_method()
      .in_detail(
          "Of a method's points on the clean surface; the reference is ended with as many points, by "
          "persistence cancellation");
  command.text("--reference-field", request.reference_field, "Morse function of the reference")
      .is_function()
      .shows_default("each method's own field");
}

}  // namespace

void add_stability(Program& program) {
  auto options = std::make_shared<Options>();
  StabilityRequest& request = options->request;
  Command& command = program.add(
      "stability",
      "How well critical points repeat on perturbed surfaces: with noise, with fewer vertices, with more");
  command.path("MESH", options->mesh, mesh_help()).required();
  command.texts("--field", request.fields, "Morse function; repeatable").is_function();
  add_methods_option(command, request.methods);
  add_target_option(command, request.target).shortly("End with K critical points, too").help =
      "Besides each method's own count: end with K critical points, or fewer";
  add_preset_option(command, [&request](const std::string& name) { apply_preset(name, request); });
  add_table_option(command, options->output, "Write trials (.json) or rows (.csv) here; - is standard output")
      .in_detail(
          "Every trial, or a row for each method and perturbation. Should it be interrupted, "
          "OUT.journal holds the trials that are done, and the same command goes on from there");
  command
      .path("--figures", options->figure_folder,
            "Write plots of F over noise and over vertices (.svg, .png) here")
      .value("DIR")
      .shapes_nothing();
  add_perturbation_options(command, request);
  add_agreement_options(command, request);
  add_common_options(command, program.common);
  command.examples = {{"stability scan.off", "three methods at four strengths of noise, ten trials each"},
                      {"stability scan.off --method salient --decimate 0.5,0.25 --target 40 -o stability.csv",
                       "40 points with half and with a quarter of the vertices"},
                      {"stability scan.off --preset resampled --target 20 --figures plots",
                       "the preset's field and methods, made for 20 points; plots"}};
  add_specification_notes(command);
  set_action(program, command, options, measure_stability);
}

}  // namespace morsel::tools
