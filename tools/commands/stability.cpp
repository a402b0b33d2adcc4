// morsel stability: how well critical points repeat on perturbed surfaces.

#include <algorithm>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/commands/table_target.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/stability_table.h"
#include "morsel/tools/report/stability_writer.h"
#include "morsel/tools/report/trial_journal.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  StabilityRequest request;
  std::string output;
};

int measure_stability(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  const StabilityPlan prepared = prepare(options.request);
  const StabilityRequest request = with_defaults(options.request);
  RunFiles files;
  files.reads("MESH", options.mesh);
  for (const std::string& field : request.fields) files.reads_of_field(field);
  if (!request.reference_field.empty()) files.reads_of_field(request.reference_field);
  write_table(files, options.output).check();
  TableTarget target(options.output);

  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, console.progress());
  const ReportInput about{options.mesh, input.sha256, common.repair, true, load_watch.seconds()};
  std::optional<TrialJournal> trials;
  if (Journal* journal = target.open_journal(trials_key(request, about))) {
    trials.emplace(*journal, prepared.targets.size() * prepared.functions.size() * prepared.chains.size());
    for (const std::string& warning : journal->warnings()) console.warning(warning);
  }
  if (trials && trials->count() > 0)
    console.message("going on with " + std::to_string(trials->count()) +
                    " perturbed surfaces done: " + options.output + ".journal");
  const StabilityResult result =
      run_stability(input.loaded, prepared, console.progress(), trials ? &*trials : nullptr);
  for (const FieldOutcome& field : result.fields) tell_warnings(field, console);
  for (std::size_t i = 0; i < result.outcomes.size() / prepared.targets.size(); ++i)  // the first target's
    tell_warnings(result.outcomes[i].clean.steps, console);
  const StabilityReport report{input.loaded, about, request, prepared, result};
  target.write([&](JsonSink& json) { write_stability(json, report); },
               [&](std::ostream& out) { write_stability_csv(out, report); });
  if (!target.is_stdout()) std::cout << stability_table(prepared, result);
  if (target.is_file()) console.message("stability: " + options.output);
  return kDone;
}

/// An option whose values are named by to_string(); the first is the default.
template <class Choice>
void add_choice(Command& command, const std::string& name, Choice& chosen,
                std::initializer_list<Choice> choices, const std::string& help) {
  std::vector<std::pair<std::string, Choice>> named;
  for (const Choice choice : choices) named.emplace_back(to_string(choice), choice);
  command.choice(name, chosen, std::move(named), help);
}

void add_perturbation_options(Command& command, StabilityRequest& request) {
  command
      .numbers("--noise", request.noise,
               "Gaussian noise of these standard deviations, in mean edge lengths (default, if no "
               "perturbation is given: 0.05,0.15,0.3,0.5)")
      .value("S,S,...");
  add_choice(command, "--kind", request.noise_kind, {NoiseKind::normal, NoiseKind::isotropic},
             "Noise along the vertex normals (normal) or in x, y and z independently (isotropic)");
  command
      .numbers("--decimate", request.decimate,
               "Edges collapsed, short ones first, until these shares of the vertices are left")
      .value("R,R,...");
  command.numbers("--subdivide", request.subdivide,
                  "Every edge cut into so many equal pieces, the surface staying the same");
  command.number("--trials", request.trials, "Trials of each random perturbation").between(1, 1'000'000);
  command.number("--seed", request.seed, "Of the random numbers: a trial depends on it and its number");
}

}  // namespace

void add_stability(Program& program) {
  auto options = std::make_shared<Options>();
  StabilityRequest& request = options->request;
  Command& command = program.add(
      "stability",
      "How well critical points repeat on perturbed surfaces: with noise, with fewer vertices, with more");
  command.path("MESH", options->mesh, mesh_help()).required();
  command.texts("--field", request.fields, "Morse function; may be given several times").value("F");
  add_methods_option(command, request.methods);
  add_perturbation_options(command, request);
  add_target_option(command, request.target);
  command.option("--target").help =
      "Besides each method's own count, end with so many critical points, or with the nearest smaller "
      "number that can be had: as much of the (last) method as leaves enough of them, persistence "
      "cancellation for the rest";
  command
      .text("--radius", request.radius,
            "Points match within this length, or this percentage of the bounding box's diagonal")
      .value("R");
  add_choice(command, "--points", request.points, {PointChoice::all, PointChoice::extrema},
             "Which points are compared: all or extrema");
  command
      .text("--reference", request.reference,
            "Agreement is the share of a method's clean points that this method has too, ended with as "
            "many points by persistence cancellation")
      .value("M");
  command
      .text("--reference-field", request.reference_field,
            "Morse function of the reference (default: that of the method, unsmoothed)")
      .value("F");
  command
      .path("-o,--output", options->output,
            "Write every trial (.json) or a row for each method and perturbation (.csv) here; - is JSON "
            "on standard output. Should it be interrupted, OUT.journal holds the trials that are done, and "
            "the same command goes on from there")
      .value("OUT");
  add_common_options(command, program.common);
  command.examples = {{"stability scan.off", "three methods at four strengths of noise, ten trials each"},
                      {"stability scan.off --method salient --decimate 0.5,0.25 --target 40 -o stability.csv",
                       "40 points with half and with a quarter of the vertices"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) {
    return measure_stability(*options, program.common, console);
  };
}

}  // namespace morsel::tools
