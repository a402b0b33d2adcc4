// morsel batch: a comparison of every mesh of a collection.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "morsel/core/text/printable.h"
#include "morsel/tools/batch/batch.h"
#include "morsel/tools/batch/summary.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/formats/text_table.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string collection;
  std::string out;
  batch::BatchRequest request;
  batch::RunOptions run;
  std::size_t jobs = 0;  // 0: as many as the machine has cores for
  std::vector<std::string> only;
  bool no_items = false;
  bool no_thumbnails = false;
  bool no_summary = false;
  bool summary_only = false;
  bool plan = false;
  bool with_timings = false;
};

/// The meshes of `all` that were chosen are as they came out of the run, the others as they are found.
std::vector<batch::MeshOutcome> whole_collection(const std::vector<batch::CollectionMesh>& all,
                                                 std::vector<batch::MeshOutcome> ran, const Options& options,
                                                 const batch::OutFolder& out,
                                                 const core::Progress& progress) {
  if (ran.size() == all.size()) return ran;
  std::set<std::string_view> names;
  for (const batch::MeshOutcome& outcome : ran) names.insert(outcome.mesh.name);
  std::vector<batch::CollectionMesh> others;
  for (const batch::CollectionMesh& mesh : all)
    if (!names.contains(mesh.name)) others.push_back(mesh);
  std::vector<batch::MeshOutcome> found = look_at(others, options.request, options.run, out, progress);
  std::vector<batch::MeshOutcome> whole;
  whole.reserve(all.size());
  auto one = ran.begin();
  auto other = found.begin();
  for (const batch::CollectionMesh& mesh : all)
    whole.push_back(std::move(one != ran.end() && one->mesh == mesh ? *one++ : *other++));
  return whole;
}

void warn_of_damaged_states(const std::vector<batch::MeshOutcome>& outcomes, Console& console) {
  const auto is_damaged = [](const batch::MeshOutcome& outcome) { return !outcome.state_damage.empty(); };
  const auto first = std::find_if(outcomes.begin(), outcomes.end(), is_damaged);
  if (first == outcomes.end()) return;
  const auto count = static_cast<std::size_t>(std::count_if(first, outcomes.end(), is_damaged));
  console.warning(grouped(count) + (count == 1 ? " damaged state counts" : " damaged states count") +
                  " as absent: " + first->state_damage);
}

/// A name as a plan has it: a JSON string if it has characters that a terminal would not just show, or looks
/// like one; else as it is.
std::string planned_name(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  const std::string shown = core::json_printable(text);
  return shown == text && !name.starts_with('"') ? name : '"' + shown + '"';
}

/// A line for each of the meshes that a run would work on.
void print_plan(const std::vector<batch::CollectionMesh>& meshes, const Options& options,
                const batch::OutFolder& out, Console& console) {
  const std::vector<batch::MeshOutcome> outcomes =
      look_at(meshes, options.request, options.run, out, console.progress());
  warn_of_damaged_states(outcomes, console);
  for (const batch::MeshOutcome& outcome : outcomes) {
    if (outcome.status != batch::Status::not_run &&
        !(outcome.status == batch::Status::failed && options.run.retry))
      continue;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(outcome.mesh.path, error);
    std::cout << (error ? 0 : size) << '\t' << planned_name(outcome.mesh.name) << '\n';
  }
}

std::string last_line(const batch::Tally& sums, const Options& options) {
  const std::size_t all = sums.done + sums.failed + sums.not_run;
  return grouped(all) + (all == 1 ? " mesh: " : " meshes: ") + grouped(sums.done) + " done, " +
         grouped(sums.failed) + " failed" +
         (sums.not_run > 0 ? ", " + grouped(sums.not_run) + " not run" : "") +
         (sums.settled > 0 ? " (" + grouped(sums.settled) + " by earlier runs)" : "") +
         (options.no_summary ? "" : "; " + (std::filesystem::path(options.out) / "index.html").string());
}

int compare_all(Options& options, const Run& run) {
  if (!options.no_thumbnails) drawing::require_pictures("morsel batch without --no-thumbnails");
  if (options.request.figures) drawing::require_pictures("--figures");
  Console& console = run.console;
  options.request.build = run.common.build;
  options.request.items = !options.no_items;
  options.request.thumbnails = !options.no_thumbnails;
  options.run.threads = std::max(run.common.threads, 1);
  options.run.stop = console.stop_token();
  const unsigned cores = std::max(std::thread::hardware_concurrency(), 1U);
  options.run.jobs = options.jobs > 0
                         ? options.jobs
                         : std::max<std::size_t>(cores / static_cast<unsigned>(options.run.threads), 1);
  static_cast<void>(prepare(options.request.comparison));
  options.request.figure.check();
  const std::vector<batch::CollectionMesh> meshes = batch::read_collection(options.collection, options.only);
  const std::vector<batch::CollectionMesh> all =
      options.only.empty() || options.no_summary ? meshes : batch::read_collection(options.collection);
  const batch::OutFolder out(options.out);
  RunFiles files;
  files.reads_folder("COLLECTION", options.collection).reads_of_field(options.request.comparison.field);
  files.reads_mask(run.common.build).fills("--out", options.out).check();
  if (options.plan) {
    ResultFolder::check(options.out);
    print_plan(meshes, options, out, console);
    return kDone;
  }
  ResultFolder results(options.out, {files.outputs(), options.run.stop});
  if (!options.no_summary) batch::check_summary(results);

  const auto tell = [&](const batch::MeshOutcome& outcome) {
    console.message(outcome.mesh.name + ": " +
                    (outcome.state.error ? "failed: " + outcome.state.error->message : "done"));
    for (const std::string& warning : mesh_warnings(outcome.state))
      console.warning(outcome.mesh.name + ": " + warning);
  };
  std::vector<batch::MeshOutcome> outcomes =
      options.summary_only
          ? look_at(meshes, options.request, options.run, out, console.progress())
          : run_batch(meshes, options.request, options.run, results, console.progress(), tell);
  warn_of_damaged_states(outcomes, console);
  const batch::Tally sums = tally(outcomes);
  if (!options.no_summary)
    write_summary(whole_collection(all, std::move(outcomes), options, out, console.progress()),
                  options.request, {options.collection, options.with_timings}, results);
  std::cout << core::printable(last_line(sums, options)) << '\n';
  return sums.failed + sums.not_run > 0 ? kDifferences : kDone;
}

void add_what_is_made(Command& command, Options& options) {
  batch::BatchRequest& request = options.request;
  add_comparison_options(command, request.comparison);
  command.begin_group("What is made of each mesh");
  command.flag("--no-items", options.no_items,
               "Leave what is listed point by point out of reports; counts stay");
  command.flag("--no-thumbnails", options.no_thumbnails, "Take no small pictures");
  command.flag("--html", request.pages, "Make a page that shows all this in a browser");
  command.flag("--figures", request.figures, "Make pictures of each method, diagrams and curves");
  command.flag("--export", request.exports,
               "Write surfaces, complexes (.vtp, for ParaView) and points (.csv)");
  add_figure_options(command, request.figure);
  for (const char* option : {"--size", "--view", "--up", "--inset"})
    command.option(option).told_by = "compare";
}

void add_how_it_is_run(Command& command, Options& options) {
  command.begin_group("How it is run");
  command.number("--jobs", options.jobs, "Meshes at the same time")
      .between(1, 4096)
      .shows_default("the cores over --threads");
  command.number("--time-limit", options.run.limits.seconds, "A mesh that takes longer fails")
      .above(0)
      .value("SECONDS")
      .shows_default("none");
  command.number("--memory-limit", options.run.limits.memory_mib, "A mesh that needs more memory fails")
      .between(64, 0x1p40)
      .value("MIB")
      .shows_default("none")
      .in_detail(
          "Writable memory of its own (heap and stacks; not code), from 64 MiB on, of which the program "
          "itself takes 45");
  command.flag("--retry", options.run.retry, "Run what failed before again");
  command.texts("--only", options.only, "Run this mesh only, by its path in COLLECTION; repeatable")
      .value("NAME");
  command.flag("--no-summary", options.no_summary, "Leave the summary to a later call");
  command.flag("--summary-only", options.summary_only, "Run nothing: write the summary of what is there")
      .excludes("--no-summary");
  command.flag("--plan", options.plan, "Run nothing: print the meshes that a run would work on")
      .excludes("--no-summary")
      .excludes("--summary-only")
      .in_detail(
          "A line each: the size of the file in bytes, a tab, NAME (a JSON string if it has control "
          "characters or begins with a quote)");
  command.flag("--with-timings", options.with_timings, "Give summary.csv a column of seconds")
      .in_detail("They differ from run to run");
}

}  // namespace

void add_batch(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "batch",
      "Compare methods on every mesh of a collection, each once and in a process of its own, and sum up");
  command.path("COLLECTION", options->collection, "A folder of meshes, or a file that lists paths of meshes")
      .required()
      .in_detail(
          "Of a folder its meshes and those of the folders in it; of a list the path on each line, relative "
          "to the list's folder");
  command.path("--out", options->out, "A new or empty folder for results, or one of an earlier batch")
      .value("OUT")
      .required()
      .shapes_nothing()
      .in_detail("It is not within COLLECTION");
  add_what_is_made(command, *options);
  add_how_it_is_run(command, *options);
  add_common_options(command, program.common);
  command.option("--threads").help = "Number of threads of each mesh; never changes a result";
  command.option("--threads").shows_default("1");
  command.examples = {
      {"batch scans --out results", "a table, a page and a report of each mesh of a folder"},
      {"batch scans --out results --figures --jobs 2", "pictures as well, of what is done, too"}};
  command.notes = "Exit code: 0 if all meshes are done, 1 if any failed. ";
  command.details =
      "OUT gets reports/NAME.json, thumbnails/NAME.first.png and .last.png (the first and the last method), "
      "pages/NAME.html, figures/NAME/ and exports/NAME/ if they are asked for, state/NAME.json, and the "
      "summary: summary.csv, summary.json, plots/ and index.html. NAME is the mesh's path within the "
      "collection. What is done is not done again unless the mesh, the options, a file that they name or the "
      "program's version changed; what failed, unless these or the limits did, or with --retry.\n\n";
  add_specification_notes(command);
  set_action(program, command, options, compare_all);
}

}  // namespace morsel::tools
