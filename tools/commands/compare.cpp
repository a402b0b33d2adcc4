// morsel compare: the main job.

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "morsel/core/file_writer.h"
#include "morsel/core/parallel.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/export/export_sink.h"
#include "morsel/tools/plot/plot_sink.h"
#include "morsel/tools/render/figure_sink.h"
#include "morsel/tools/report/comparison_table.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/report_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  ComparisonRequest request;
  std::string report;
  bool no_items = false;
  std::string export_folder;
  std::string figure_folder;
  std::string figure_size = "1200x840";
  render::CameraText camera;
};

/// Shows on the console which method is running.
class Announcer : public ComparisonSink {
 public:
  explicit Announcer(Console& console) : console_(console) {}
  void begin_method(const std::string& name) override { console_.enter(name); }
  void field(const FieldOutcome&) override {}
  void method(const MethodOutcome&) override {}

 private:
  Console& console_;
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

int compare(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  const PreparedComparison comparison = prepare(options.request);
  options.camera.check();
  const bool report_to_stdout = options.report == "-";
  std::optional<core::FileWriter> file;
  if (!options.report.empty() && !report_to_stdout) file.emplace(options.report);
  const render::Size figure_size = render::parse_size(options.figure_size);
  std::optional<PlotSink> plots;
  if (!options.figure_folder.empty()) plots.emplace(options.figure_folder);

  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, console.progress());
  const core::LoadedMesh& loaded = input.loaded;
  const ReportInput about{options.mesh, input.sha256, common.repair, !options.no_items, load_watch.seconds()};

  Announcer announcer(console);
  ComparisonTable table;
  SideBySide files;
  std::optional<JsonStream> json;
  std::optional<ReportWriter> report;
  if (file || report_to_stdout) {
    json.emplace(report_to_stdout ? std::cout : file->stream());
    report.emplace(*json, loaded, about, options.request);
    files.add(*report);
  }
  std::optional<ExportSink> exports;
  if (!options.export_folder.empty()) {
    exports.emplace(options.export_folder, loaded);
    files.add(*exports);
  }
  if (plots) files.add(*plots);
  std::vector<ComparisonSink*> sinks = {&announcer, &table, &files};
  std::optional<render::FigureSink> figures;
  if (!options.figure_folder.empty()) {
    figures.emplace(options.figure_folder, loaded, options.camera, figure_size, console.progress());
    sinks.push_back(&*figures);
  }
  run_comparison(loaded, comparison, sinks, console.progress());
  if (figures) figures->finish();
  if (plots) plots->finish();
  if (report) report->finish();
  if (file) file->commit();

  if (!report_to_stdout) std::cout << table.text();
  if (file) console.message("report: " + options.report);
  if (exports) console.message("files for ParaView: " + options.export_folder);
  if (figures) console.message("pictures and plots: " + options.figure_folder);
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("compare",
                          "Run methods on a field and hold their critical points, diagrams and complexes\n"
                          "against each other");
  command.add_option("MESH", options->mesh, kMeshHelp)->required();
  command.add_option("--field", options->request.field, "Morse function (below)")
      ->type_name("F")
      ->capture_default_str();
  command
      .add_option("--method", options->request.methods,
                  "A method or chain of methods (below); may be given several times\n"
                  "(default: conventional, salient and tps)")
      ->type_name("M")
      ->allow_extra_args(false);
  add_target_option(command, options->request.target);
  command.add_flag("--snap", options->request.snap,
                   "Report each critical point at the position of the one of the input field that it came\n"
                   "from (its origin)");
  command.add_option("-o,--output", options->report, "Write the JSON report here; - is standard output")
      ->type_name("REPORT.json");
  command.add_flag("--no-items", options->no_items,
                   "Leave what is listed point by point out of the report: the critical points and the\n"
                   "diagram's pairs; their counts stay");
  command
      .add_option("--export", options->export_folder,
                  "Write each method's surface, complex (.vtp, for ParaView) and critical points (.csv) here")
      ->type_name("DIR");
  command
      .add_option(
          "--figures", options->figure_folder,
          "Write pictures here: one of each method, a sheet with them side by side (.png), persistence\n"
          "diagrams, and curves of count against persistence and against iteration (.svg and .png)")
      ->type_name("DIR");
  command.add_option("--size", options->figure_size, "Width and height of each method's picture in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  add_camera_options(command, options->camera);
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, &invocation] {
    invocation.action = [options, &invocation](Console& console) {
      return compare(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
