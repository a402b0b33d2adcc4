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
  const PreparedStability prepared = prepare(options.request);
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
  const StabilityReport report{input.loaded, about, request, prepared, result};
  target.write([&](JsonSink& json) { write_stability(json, report); },
               [&](std::ostream& out) { write_stability_csv(out, report); });
  if (!target.is_stdout()) std::cout << stability_table(prepared, result);
  if (target.is_file()) console.message("stability: " + options.output);
  return kDone;
}

/// An option whose values are named by to_string(); the first is the default.
template <class Choice>
void add_choice(CLI::App& command, const std::string& name, Choice& chosen,
                std::initializer_list<Choice> choices, const std::string& description) {
  std::vector<std::string> names;
  for (const Choice choice : choices) names.emplace_back(to_string(choice));
  const std::vector<Choice> values = choices;
  command
      .add_option_function<std::string>(
          name,
          [&chosen, names, values](const std::string& text) {
            chosen = values[static_cast<std::size_t>(std::ranges::find(names, text) - names.begin())];
          },
          description)
      ->check(CLI::IsMember(names))
      ->default_str(names.front())
      ->type_name("WHICH");
}

void add_perturbation_options(CLI::App& command, StabilityRequest& request) {
  command
      .add_option("--noise", request.noise,
                  "Gaussian noise of these standard deviations, in mean edge lengths (default, if no\n"
                  "perturbation is given: 0.05,0.15,0.3,0.5)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("S,S,...");
  add_choice(command, "--kind", request.noise_kind, {NoiseKind::normal, NoiseKind::isotropic},
             "Noise along the vertex normals (normal) or in x, y and z independently (isotropic)");
  command
      .add_option("--decimate", request.decimate,
                  "Edges collapsed, short ones first, until these shares of the vertices are left")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("R,R,...");
  command
      .add_option("--subdivide", request.subdivide,
                  "Every edge cut into so many equal pieces, the surface staying the same")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("N,N,...");
  command.add_option("--trials", request.trials, "Trials of each random perturbation")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--seed", request.seed, "Of the random numbers: a trial depends on it and its number")
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

void add_stability(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<Options>();
  StabilityRequest& request = options->request;
  CLI::App& command = *app.add_subcommand(
      "stability",
      "How well critical points repeat on perturbed surfaces: with noise, with fewer vertices, with more");
  command.add_option("MESH", options->mesh, kMeshHelp)->check(names_file())->required();
  command.add_option("--field", request.fields, "Morse function (below); may be given several times")
      ->type_name("F")
      ->allow_extra_args(false)
      ->default_str("mean-curvature");
  add_methods_option(command, request.methods);
  add_perturbation_options(command, request);
  add_target_option(command, request.target);
  command.get_option("--target")
      ->description(
          "Besides each method's own count, end with so many critical points, or with the nearest smaller\n"
          "number that can be had: as much of the (last) method as leaves enough of them, persistence\n"
          "cancellation for the rest");
  command
      .add_option("--radius", request.radius,
                  "Points match within this length, or this percentage of the bounding box's diagonal")
      ->type_name("R")
      ->capture_default_str();
  add_choice(command, "--points", request.points, {PointChoice::all, PointChoice::extrema},
             "Which points are held against each other: all or extrema");
  command
      .add_option(
          "--reference", request.reference,
          "Agreement is the share of a method's clean points that this method has too, ended with as\n"
          "many points by persistence cancellation")
      ->type_name("M")
      ->capture_default_str();
  command
      .add_option("--reference-field", request.reference_field,
                  "Morse function of the reference (default: the first --field)")
      ->type_name("F");
  command
      .add_option(
          "-o,--output", options->output,
          "Write every trial (.json) or a row for each method and perturbation (.csv) here; - is JSON\n"
          "on standard output. Should it be interrupted, OUT.journal holds the trials that are done, and\n"
          "the same command goes on from there")
      ->check(names_file())
      ->type_name("OUT");
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, &invocation] {
    invocation.action = [options, &invocation](Console& console) {
      return measure_stability(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
