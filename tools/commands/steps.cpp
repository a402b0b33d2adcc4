#include "morsel/tools/commands/steps.h"

#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/mesh/welding.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/numbers.h"
#include "morsel/tools/commands/standard_input.h"

namespace morsel::tools {

void check_writable(const core::FileTarget& target) {
  std::error_code error;
  if (target.is_open_file() || (!target.path.empty() && !std::filesystem::is_fifo(target.path, error)))
    const core::FileWriter probe(target);
}

std::unique_ptr<ResultFolder> open_folder(const std::string& path, const RunFiles& files, const Run& run) {
  if (path.empty()) return nullptr;
  return std::make_unique<ResultFolder>(path,
                                        ResultFolder::Options{files.outputs(), run.console.stop_token()});
}

void fail_without_format(const std::vector<std::string>& formats) {
  throw core::InvalidArgument("of standard input (-) the format must be given: --format " +
                              core::listed(formats, " or "));
}

MeshOrigin mesh_file(const std::string& path, const Run& run) {
  MeshOrigin file{path};
  if (!run.common.format.empty()) file.format = core::mesh_format_named(run.common.format);
  if (path != kStandardInput) return file;
  if (!file.format) fail_without_format(core::mesh_format_names());
  file.path = "standard input";
  file.bytes = standard_input(run.console.progress());
  return file;
}

MeshInput read_input(const std::string& path, std::span<const NamedFunction> functions, const Run& run,
                     bool items) {
  const Stopwatch watch;
  HashedMesh mesh =
      read_hashed_mesh(mesh_file(path, run), build_for(functions, run.common.build), run.console.progress());
  tell_warnings(mesh.loaded, run.console);
  return {std::move(mesh.loaded),
          {path, std::move(mesh.sha256), run.common.build, items, watch.seconds(), run.common.format}};
}

void tell_warnings(const core::LoadedMesh& loaded, Console& console) {
  if (loaded.source.warnings.empty()) return;
  for (const std::string& warning : loaded.source.warnings) console.warning(warning);
  console.set_cause(core::unwelded_warning(loaded.mesh, loaded.source.numbering));
}

void tell_warnings(const FieldOutcome& field, Console& console) {
  for (const std::string& warning : field.warnings) console.warning(field.name + ": " + warning);
}

void tell_warnings(const std::vector<StepOutcome>& steps, Console& console) {
  for (const StepOutcome& step : steps)
    for (const std::string& warning : step.warnings) console.warning(step.name + ": " + warning);
}

void tell_made(const MadeField& made, Console& console) {
  tell_warnings(made.input, console);
  tell_warnings(made.outcome.steps, console);
  if (!made.outcome.target) return;
  for (const std::string& text : {made.outcome.target->note, early_end(*made.outcome.target)})
    if (!text.empty()) console.message(text);
}

void tell_points(const MadePoints& made, const PointsRequest& request, Console& console) {
  if (made.fill) tell_warnings(*made.fill, console);
  const std::size_t count = made.chosen.points.size();
  std::string text = "points: " + core::grouped(count);
  if (count > 1 && made.chosen.spacing > 0)
    text += ", at least " + core::to_digits(made.chosen.spacing) + " (" + core::to_string(request.spacing) +
            ") apart along the surface";
  if (const std::optional<double> mean = made.mean_percentile())
    text += "; mean saliency percentile " + core::to_decimals(*mean, 2);
  console.message(text);
  if (!made.note.empty()) console.message(made.note);
}

FieldRun::FieldRun(const std::string& mesh, const FieldRequest& request, const Run& run)
    : run_(run), plan_(prepare(request)), file_{mesh, {}} {
  files_.reads_mesh(mesh, run.common.format).reads_mask(run.common.build).reads_of_field(request.field);
}

FieldRun& FieldRun::writes(const std::string& option, const core::FileTarget& target, CheckPath check_path) {
  if (target.path.empty()) return *this;
  if (check_path != nullptr) check_path(target);
  files_.writes(option, target);
  written_.push_back(target);
  return *this;
}

FieldRun& FieldRun::writes_document(const std::string& option, const core::FileTarget& target) {
  files_.writes_document(option, target);
  return *this;
}

FieldRun& FieldRun::reads(const std::string& option, const std::filesystem::path& path) {
  files_.reads(option, path);
  return *this;
}

FieldRun& FieldRun::reads_of_field(const std::string& specification, const std::string& option) {
  files_.reads_of_field(specification, option);
  return *this;
}

void FieldRun::check_files() const {
  files_.check();
  for (const core::FileTarget& target : written_) check_writable(target);
}

void FieldRun::read() {
  MeshInput input = read_input(file_.path, std::span(&plan_.function, 1), run_);
  file_ = input.file();
  load_seconds_ = input.about.load_seconds;
  mesh_.emplace(core::WholeMesh{std::move(input.loaded), {}});
}

void FieldRun::read_whole() {
  const Stopwatch watch;
  HashedWholeMesh mesh = read_hashed_whole_mesh(
      mesh_file(file_.path, run_), build_for(plan_.function, run_.common.build), run_.console.progress());
  tell_warnings(mesh.input.loaded, run_.console);
  file_.sha256 = std::move(mesh.sha256);
  mesh_.emplace(std::move(mesh.input));
  load_seconds_ = watch.seconds();
}

void FieldRun::make() {
  made_.emplace(make_field(plan_, loaded(), run_.console.progress()));
  tell_made(*made_, run_.console);
}

MadePoints FieldRun::choose_points(const PointsPlan& plan) {
  const Stopwatch watch;
  MadePoints points = make_points(plan, loaded(), *made_, run_.console.progress());
  points_seconds_ = watch.seconds();
  tell_points(points, plan.request, run_.console);
  return points;
}

Provenance FieldRun::provenance(const Json& request) const {
  return {run_.common.command, request, source()};
}

Timings FieldRun::timings(const Timings& more) const {
  Timings all = {{"load", load_seconds_}, {"field", made_->input.seconds}, {"method", made_->method_seconds}};
  if (points_seconds_) all.emplace_back("points", *points_seconds_);
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace morsel::tools
