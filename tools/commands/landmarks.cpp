// morsel landmarks: how well chosen critical points agree with points that people marked.

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/commands/points_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/commands/table_target.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/plot/landmarks_plots.h"
#include "morsel/tools/plot/plot_files.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/landmarks_journal.h"
#include "morsel/tools/report/landmarks_table.h"
#include "morsel/tools/report/landmarks_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string list;
  LandmarksRequest request;
  ChoiceOptions choice;
  std::string radius = core::to_string(LandmarksRequest().radius);
  std::string largest_radius = core::to_string(LandmarksRequest().largest_radius);
  std::string output;
  std::string figure_folder;
};

LandmarksRequest landmarks_request(const Options& options) {
  LandmarksRequest request = options.request;
  request.choice = options.choice.request();
  request.radius = core::parse_length(options.radius, "--radius");
  request.largest_radius = core::parse_length(options.largest_radius, "--largest-radius");
  return request;
}

RunFiles files_of(const Options& options, const MarkedFiles& files, const core::FileTarget& output) {
  RunFiles named;
  named.reads("LIST", options.list);
  for (std::size_t i = 0; i < files.size(); ++i)
    named.reads_mesh_file("mesh of LIST,", files.path_of(i))
        .reads("vertices of LIST,", files.marks_path_of(i));
  for (const std::string& field : options.request.fields) named.reads_of_field(field);
  reads_of_points(named, options.request.choice);
  named.reads_mask(files.build());
  write_table(named, output).fills("--figures", options.figure_folder).check();
  return named;
}

void tell_warnings(const MarkedFiles& files, const std::vector<LandmarksOnMesh>& meshes, Console& console) {
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string mesh = files.name(i) + ": ";
    for (const std::string& warning : files.warnings(i)) console.warning(mesh + warning);
    for (const std::string& warning : meshes[i].warnings) console.warning(warning);
    for (const FieldSummary& field : meshes[i].fields)
      for (const std::string& warning : field.warnings) console.warning(mesh + field.name + ": " + warning);
    for (const LandmarkRow& row : meshes[i].rows) {
      for (const std::string& warning : row.warnings) console.warning(mesh + warning);
      if (row.fill)
        for (const std::string& warning : row.fill->warnings)
          console.warning(mesh + row.fill->name + ": " + warning);
    }
  }
}

/// How often there were fewer points than wanted.
void tell_fewer(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes,
                const std::vector<LandmarksSummary>& summaries, Console& console) {
  for (std::size_t row = 0; row < plan.made_rows(); ++row) {
    if (summaries[row].fewer == 0) continue;
    std::string text = plan.name_of(row) + " has fewer points than wanted on " +
                       core::grouped(summaries[row].fewer) + " of " + core::grouped(meshes.size()) +
                       (meshes.size() == 1 ? " mesh" : " meshes");
    for (const LandmarksOnMesh& mesh : meshes)
      if (!mesh.rows[row].note.empty()) {
        text += " (" + mesh.rows[row].note + ")";
        break;
      }
    console.message(text);
  }
}

int measure_landmarks(const Options& given, const Run& run) {
  if (!given.figure_folder.empty()) drawing::require_pictures("--figures");
  Options options = given;
  options.request = landmarks_request(given);
  const LandmarksRequest& request = options.request;
  const LandmarksPlan plan = prepare(request);
  const Stopwatch watch;
  MarkedFiles files(options.list, request.first, build_for(plan.functions, run.common.build));
  const core::FileTarget output = output_target(options.output, run);
  const RunFiles named = files_of(options, files, output);
  const std::unique_ptr<ResultFolder> figures = open_folder(options.figure_folder, named, run);
  TableTarget target(output);

  const std::vector<HashedFile> field_files = input_files(fields_of(request));
  std::optional<LandmarksJournal> done;
  if (Journal* journal = target.open_journal(landmarks_key(request, run.common.build, field_files)))
    done.emplace(*journal, files, plan, field_files);
  target.tell_journal(done ? done->count() : 0, " meshes done", run.console);
  const std::vector<LandmarksOnMesh> meshes =
      run_landmarks(files, plan, run.console.progress(), done ? &*done : nullptr);
  tell_warnings(files, meshes, run.console);
  const std::vector<LandmarksSummary> summaries = summarize(plan, meshes);

  const LandmarksReport report{files, plan, meshes, summaries, field_files, watch.seconds()};
  target.write([&](JsonSink& json) { write_landmarks(json, report); },
               [&](std::ostream& out) { write_landmarks_csv(out, report); });
  if (figures)
    plot::write_plots(
        *figures,
        {{"errors", plot::landmark_errors(plan, summaries)}, {"scores", plot::landmark_scores(plan, meshes)}},
        Provenance(run.common.command, request_section(request, run.common.build), report.inputs()));
  show(landmarks_table(plan, meshes, summaries), run);
  tell_fewer(plan, meshes, summaries, run.console);
  target.tell("landmarks", run);
  if (figures) run.console.message("plots: " + options.figure_folder);
  return kDone;
}

void add_scoring_options(Command& command, Options& options) {
  command.begin_group("How points and marks are compared");
  command.text("--radius", options.radius, "A hit lies within this length along the surface")
      .value("R")
      .in_detail("Distances along the surface are those of --spacing");
  command
      .text("--largest-radius", options.largest_radius, "Errors are also counted over the radii up to this")
      .value("R");
  command.number("--first", options.request.first, "The number of a mesh's first vertex in the files: 0 or 1")
      .between(0, 1);
  command.number("--resamples", options.request.resamples, "Resamples of the meshes that intervals are from")
      .between(100, kMostResamples);
  command.number("--seed", options.request.seed, "Seed of the random points and of the resamples");
}

}  // namespace

void add_landmarks(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command =
      program.add("landmarks", "How well chosen critical points agree with points that people marked");
  command.path("LIST", options->list, "Pairs of a mesh and a file of its marked vertices, one a line")
      .required()
      .in_detail(
          "Two paths separated by a comma, a tab or white space, in double quotes where they have such "
          "characters; relative ones begin at the list's folder; lines that begin with # are skipped, as is "
          "a heading whose first word is mesh. A file of vertices holds numbers, separated by white space or "
          "commas; or lines of a number and a position; or a table whose first column is called vertex, such "
          "as morsel points writes");
  command.texts("--field", options->request.fields, "Morse function; repeatable").is_function();
  add_methods_option(command, options->request.methods);
  command.number("--points", options->request.count, "Points that are chosen on each mesh")
      .between(1, std::numeric_limits<double>::infinity())
      .value("K")
      .shows_default("as many as it has marks");
  add_choice_options(command, options->choice);
  add_table_option(command, options->output,
                   "Write all results (.json) or rows (.csv) here; - is standard output")
      .in_detail(
          "Means and every mesh, or a row for each mesh and method. Should it be interrupted, "
          "OUT.journal holds the meshes that are done, and the same command goes on from there");
  command.path("--figures", options->figure_folder, "Write plots of errors and scores (.svg, .png) here")
      .value("DIR")
      .shapes_nothing();
  add_scoring_options(command, *options);
  add_common_options(command, program.common);
  command.examples = {
      {"landmarks marked.txt", "the field for marked points, beside chance"},
      {"landmarks marked.txt --field mean-curvature --method conventional --method salient --points 20 "
       "-o landmarks.json --figures plots",
       "20 points of two methods, with every mesh and plots"}};
  add_specification_notes(command);
  set_action(program, command, options, measure_landmarks);
}

}  // namespace morsel::tools
