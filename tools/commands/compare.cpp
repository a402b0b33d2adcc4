// morsel compare: the main job.

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/points_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/export/export_sink.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/html/html_sink.h"
#include "morsel/tools/plot/plot_sink.h"
#include "morsel/tools/render/figure_sink.h"
#include "morsel/tools/render/thumbnail_sink.h"
#include "morsel/tools/report/comparison_table.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  ComparisonRequest request;
  PointsOptions points;  // which the request gets
  std::string report;
  bool no_items = false;
  std::string export_folder;
  bool glb = false;
  std::string figure_folder;
  render::FigureText figure;
  std::string page;
  std::string page_place;
  std::string thumbnails;
};

/// Shows on the console which method is running.
class Announcer : public ComparisonSink {
 public:
  Announcer(Console& console, std::size_t methods) : console_(console), methods_(methods) {}
  void begin_method(const std::string& name) override {
    console_.enter(name + " (" + std::to_string(++begun_) + " of " + std::to_string(methods_) + ")");
  }
  void field(const FieldOutcome& outcome) override { tell_warnings(outcome, console_); }
  void method(const MethodOutcome& outcome) override { tell_warnings(outcome.steps, console_); }

 private:
  Console& console_;
  std::size_t methods_;
  std::size_t begun_ = 0;
};

/// Lets several sinks work at the same time.
class SideBySide : public ComparisonSink {
 public:
  void add(ComparisonSink& sink) { sinks_.push_back(&sink); }
  void field(const FieldOutcome& outcome) override {
    for (ComparisonSink* sink : sinks_) sink->field(outcome);
  }
  void method(const MethodOutcome& outcome) override {
    core::parallel_for(0, sinks_.size(), 1, [&](std::size_t i, std::size_t) { sinks_[i]->method(outcome); });
  }

 private:
  std::vector<ComparisonSink*> sinks_;
};

/// What makes the page again. What changes nothing in it is left out.
std::string page_command(const Options& options, const CommonOptions& common) {
  std::vector<std::string> words = {"morsel", "compare", options.mesh};
  add_words(words, words_of(options.request, common.build));
  if (!common.format.empty()) add_option(words, "--format", common.format);
  add_option(words, "--html", options.page_place.empty() ? options.page : options.page_place);
  return command_line(words);
}

/// The folders of a comparison, opened from the outside in (one with something in it is refused) and closed
/// from the inside out.
class Folders {
 public:
  Folders(const Options& options, const RunFiles& files, const std::stop_token& stop) {
    std::vector<std::string> paths = {options.figure_folder, options.export_folder};
    if (is_in(options.figure_folder, options.export_folder)) std::swap(paths[0], paths[1]);
    for (const std::string& path : paths)
      if (!path.empty() && find(path) == nullptr)
        folders_.emplace_back(path, ResultFolder::Options{files.outputs(), stop});
  }
  ~Folders() {
    while (!folders_.empty()) folders_.pop_back();
  }
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;

  ResultFolder& at(const std::string& path) { return *find(path); }

 private:
  ResultFolder* find(const std::string& path) {
    for (ResultFolder& folder : folders_)
      if (folder.path() == path) return &folder;
    return nullptr;
  }

  std::deque<ResultFolder> folders_;
};

/// All that a comparison is written to.
class Outputs {
 public:
  /// Unwritable targets are refused here, before the work.
  Outputs(const Options& options, const Run& run)
      : options_(options),
        run_(run),
        figure_size_(render::parse_size(options.figure.size)),
        report_path_(output_target(options.report, run)),
        page_path_(output_target(options.page, run)),
        folders_(options, checked_files(), run.console.stop_token()),
        report_target_(report_path_) {
    if (!options.page.empty()) page_file_.emplace(page_path_);
  }

  /// `sinks` receive the results, too. Refers to `input`.
  void run(const ComparisonPlan& comparison, const MeshInput& input, std::vector<ComparisonSink*> sinks,
           const core::Progress& progress) {
    const core::LoadedMesh& loaded = input.loaded;
    const Provenance provenance(run_.common.command, request_section(input.about, options_.request),
                                {input.file()});
    if (report_target_.is_wanted())
      files_.add(report_.emplace(report_target_.json(), loaded, input.about, options_.request));
    if (page_file_)
      files_.add(page_.emplace(*page_file_, loaded, input.about, options_.request,
                               page_command(options_, run_.common), provenance));
    if (!options_.export_folder.empty())
      files_.add(exports_.emplace(folders_.at(options_.export_folder), loaded, provenance, options_.glb));
    if (!options_.figure_folder.empty())
      files_.add(plots_.emplace(folders_.at(options_.figure_folder), provenance));
    sinks.push_back(&files_);
    if (!options_.figure_folder.empty())
      sinks.push_back(&figures_.emplace(folders_.at(options_.figure_folder), loaded, options_.figure.camera,
                                        figure_size_, provenance, progress));
    if (!options_.thumbnails.empty())
      sinks.push_back(&thumbnails_.emplace(options_.thumbnails, comparison.chains.size(),
                                           options_.figure.camera, loaded, provenance, progress));
    run_comparison(loaded, comparison, sinks, progress);
    if (figures_) figures_->finish();
    if (plots_) plots_->finish();
    if (report_) report_->finish();
    if (page_) page_->finish();
    report_target_.commit();
    if (page_file_) page_file_->commit();
  }

  void tell(const std::string& table) const {
    show(table, run_);
    report_target_.tell("report", run_);
    if (page_file_) tell_written("page", page_path_, run_);
    if (exports_) run_.console.message("files for other programs: " + options_.export_folder);
    if (figures_) run_.console.message("pictures and plots: " + options_.figure_folder);
  }

 private:
  /// All files of the run; throws if two of them are the same.
  RunFiles checked_files() const {
    RunFiles files;
    files.reads_mesh(options_.mesh, run_.common.format).reads_mask(run_.common.build);
    files.reads_of_field(options_.request.field);
    reads_of_points(files, options_.request.points);
    files.writes_document("-o", report_path_).writes_no_mesh("--html", page_path_);
    if (!options_.thumbnails.empty())
      for (const char* which : {"first", "last"})
        files.writes("--thumbnails", render::thumbnail_path(options_.thumbnails, which));
    files.fills("--figures", options_.figure_folder).fills("--export", options_.export_folder);
    files.check();
    return files;
  }

  const Options& options_;
  const Run& run_;
  render::Size figure_size_;
  core::FileTarget report_path_;
  core::FileTarget page_path_;
  Folders folders_;
  DocumentTarget report_target_;
  std::optional<core::FileWriter> page_file_;
  std::optional<ReportWriter> report_;
  std::optional<HtmlSink> page_;
  std::optional<ExportSink> exports_;
  std::optional<PlotSink> plots_;
  std::optional<render::FigureSink> figures_;
  std::optional<render::ThumbnailSink> thumbnails_;
  SideBySide files_;
};

int compare(Options& options, const Run& run) {
  options.request.points = options.points.request();
  if (!options.figure_folder.empty()) drawing::require_pictures("--figures");
  if (!options.thumbnails.empty()) drawing::require_pictures("--thumbnails");
  const ComparisonPlan comparison = prepare(options.request);
  options.figure.check();
  Outputs outputs(options, run);
  const MeshInput input =
      read_input(options.mesh, std::span(&comparison.function, 1), run, !options.no_items);
  Announcer announcer(run.console, comparison.chains.size());
  ComparisonTable table;
  outputs.run(comparison, input, {&announcer, &table}, run.console.progress());
  outputs.tell(table.text());
  return kDone;
}

void add_outputs(Command& command, Options& options) {
  command.begin_group("What is written");
  command
      .output("-o,--output", options.report, {{"json"}}, "Write the JSON report here; - is standard output")
      .value("REPORT.json");
  command.flag("--no-items", options.no_items, "Leave what is listed point by point out of it; counts stay")
      .in_detail("That is: the critical points and the diagram's pairs");
  command
      .path("--export", options.export_folder,
            "Write surfaces, complexes (.vtp, .graphml) and points (.csv) here")
      .value("DIR")
      .shapes_nothing()
      .in_detail("One of each method: .vtp for ParaView, .graphml for NetworkX and Gephi");
  command.flag("--glb", options.glb, "And scenes of surface, points and arcs (.glb)")
      .needs("--export")
      .shapes_nothing()
      .in_detail("One of each method, for slides, web pages and Blender");
  command.path("--figures", options.figure_folder, "Write pictures, persistence diagrams and curves here")
      .value("DIR")
      .shapes_nothing()
      .in_detail(
          "A picture of each method, a sheet with them side by side (.png), persistence diagrams, and curves "
          "of count against persistence and against iteration (.svg and .png)");
  command
      .path("--thumbnails", options.thumbnails, "Write small pictures: PREFIX.first.png and PREFIX.last.png")
      .value("PREFIX")
      .shapes_nothing()
      .in_detail("Of the first and of the last method");
  command.output("--html", options.page, {{"html"}}, "Write a page here that shows all this in a browser")
      .value("REPORT.html")
      .in_detail("Models to turn, diagrams, curves, numbers; one file, for which no network is needed");
  command
      .path("--html-place", options.page_place,
            "Where the page will be moved to, for the command that it shows")
      .value("PATH")
      .needs("--html")
      .shapes_nothing();
}

}  // namespace

void add_compare(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "compare", "Run methods on a field and compare their critical points, diagrams and complexes");
  command.path("MESH", options->mesh, mesh_help()).required();
  add_comparison_options(command, options->request);
  add_points_options(command, options->points, "points");
  add_outputs(command, *options);
  command.begin_group("Pictures");
  add_figure_options(command, options->figure);
  add_common_options(command, program.common);
  command.examples = {
      {"compare scan.off", "a table: conventional, salient and, at equal count, tps on the mean curvature"},
      {"compare scan.off --preset noise", "a field and methods for noisy surfaces"},
      {"compare scan.off --method conventional --method salient:iterations=20,sigma=4eps --figures out",
       "two methods, with pictures and plots"},
      {"compare scan.off --field height:axis=z --target 40 -o report.json --html report.html",
       "40 points of each method on the height, as numbers and as a page"}};
  add_specification_notes(command);
  set_action(program, command, options, compare);
}

}  // namespace morsel::tools
