// morsel compare: the main job.

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "morsel/core/file_writer.h"
#include "morsel/core/parallel.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/export/export_sink.h"
#include "morsel/tools/html/command_line.h"
#include "morsel/tools/html/html_sink.h"
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
  std::string page;
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

/// What makes the page again. What changes nothing in it is left out.
std::string page_command(const Options& options, const CommonOptions& common) {
  const ComparisonRequest& request = options.request;
  std::vector<std::string> words = {"morsel", "compare", options.mesh, "--field", request.field};
  for (const std::string& method : request.methods) words.insert(words.end(), {"--method", method});
  if (request.target) words.insert(words.end(), {"--target", std::to_string(*request.target)});
  if (request.snap) words.emplace_back("--snap");
  if (common.repair) words.emplace_back("--repair");
  words.insert(words.end(), {"--html", options.page});
  return command_line(words);
}

int compare(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  const PreparedComparison comparison = prepare(options.request);
  const bool report_to_stdout = options.report == "-";
  std::optional<core::FileWriter> file;
  if (!options.report.empty() && !report_to_stdout) file.emplace(options.report);
  std::optional<core::FileWriter> page_file;
  if (!options.page.empty()) page_file.emplace(options.page);

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
  std::optional<HtmlSink> page;
  if (page_file) {
    page.emplace(*page_file, loaded, about, options.request, page_command(options, common));
    files.add(*page);
  }
  run_comparison(loaded, comparison, {&announcer, &table, &files}, console.progress());
  if (report) report->finish();
  if (page) page->finish();
  if (file) file->commit();
  if (page_file) page_file->commit();

  if (!report_to_stdout) std::cout << table.text();
  if (file) console.message("report: " + options.report);
  if (page_file) console.message("page: " + options.page);
  if (exports) console.message("files for ParaView: " + options.export_folder);
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
          "--html", options->page,
          "Write a page here that shows all this in a browser: models to turn, diagrams, curves, numbers;\n"
          "one file, for which no network is needed")
      ->type_name("REPORT.html");
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, &invocation] {
    invocation.action = [options, &invocation](Console& console) {
      return compare(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
