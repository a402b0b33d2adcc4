// morsel check: a report is its own regression test.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/report_check.h"
#include "morsel/tools/report/report_reader.h"

namespace morsel::tools {
namespace {

constexpr std::size_t kShown = 20;  // differences of a report

struct Options {
  std::vector<std::string> paths;
  bool all = false;
};

bool is_folder(const std::string& path) {
  std::error_code error;  // of which the reader of reports has more to tell
  return std::filesystem::is_directory(path, error);
}

std::string counted(std::size_t count, const std::string& what) {
  return grouped(count) + " " + what + (count == 1 ? "" : "s");
}

/// What is said of a report in one line.
std::string verdict(const ReportCheck& check) {
  if (check.input_is_missing && check.input_path == "-")
    return "the mesh was standard input, which is not kept";
  if (check.input_is_missing)
    return (check.is_of_landmarks ? "the list " : "the mesh ") + check.input_path + " is missing";
  if (check.differences.empty())
    return "unchanged (" + counted(check.rows, check.is_of_landmarks ? "row" : "method") + " on " +
           check.input_path + ")";
  return counted(check.differences.size(), "difference") + " (report -> now)";
}

std::string left_out(std::size_t count) { return "… and " + grouped(count) + " more (--all shows them)"; }

int check_one(const std::string& path, bool all, Console& console) {
  const ReportCheck check = check_report(path, console.progress());
  std::cout << core::printable(path + ": " + verdict(check)) << '\n';
  const std::size_t shown = all ? check.differences.size() : std::min(kShown, check.differences.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Difference& difference = check.differences[i];
    std::cout << "  "
              << core::printable(difference.where + ": " + difference.before + " -> " + difference.after)
              << '\n';
  }
  if (shown < check.differences.size())
    std::cout << "  " << left_out(check.differences.size() - shown) << '\n';
  return check.is_unchanged() ? kDone : kDifferences;
}

/// A line each as they are checked, then a table of what differs.
class ManyReports {
 public:
  ManyReports(bool all, Console& console) : all_(all), console_(console) {}

  /// `is_named`: by the user, not found in a folder, where documents of other kinds may lie.
  void check(const std::string& path, bool is_named) {
    console_.enter(path);
    try {
      const ReportCheck result = check_report(path, console_.progress());
      say(path, verdict(result));
      ++(result.is_unchanged() ? unchanged_ : changed_);
      add_rows(path, result);
    } catch (const OtherDocument& error) {
      if (is_named) fail(path, error);
      if (!is_named) ++other_documents_;
    } catch (const core::BadInput& error) {
      fail(path, error);
    }
  }

  /// Throws BadInput if any could not be checked, or there was none.
  int finish() {
    const std::size_t checked = unchanged_ + changed_;
    if (rows_.size() > 1) std::cout << '\n' << text_table(rows_) << '\n';
    std::cout << counted(checked + failed_, "report") << ": " << grouped(unchanged_) << " unchanged, "
              << grouped(changed_) << " changed, " << grouped(failed_) << " not checked"
              << (other_documents_ > 0 ? "; passed over: " + counted(other_documents_, "other document") : "")
              << std::endl;
    if (failed_ > 0)
      throw core::BadInput(grouped(failed_) + " of " + counted(checked + failed_, "report") +
                           " could not be checked");
    if (checked == 0) throw core::BadInput("there is no comparison report to check");
    return changed_ > 0 ? kDifferences : kDone;
  }

 private:
  static void say(const std::string& path, const std::string& text) {
    std::cout << core::printable(path + ": " + text) << std::endl;  // seen when it is known
  }
  void fail(const std::string& path, const core::Error& error) {
    ++failed_;
    say(path, std::string("not checked: ") + error.what());
  }
  void add_rows(const std::string& path, const ReportCheck& check) {
    const std::size_t shown = all_ ? check.differences.size() : std::min(kShown, check.differences.size());
    for (std::size_t i = 0; i < shown; ++i)
      rows_.push_back(
          {path, check.differences[i].where, check.differences[i].before, check.differences[i].after});
    if (shown < check.differences.size())
      rows_.push_back({path, left_out(check.differences.size() - shown), "", ""});
  }

  bool all_;
  Console& console_;
  std::size_t unchanged_ = 0, changed_ = 0, failed_ = 0, other_documents_ = 0;
  std::vector<std::vector<std::string>> rows_ = {{"report", "what", "report has", "now"}};
};

int check(const Options& options, const Run& run) {
  if (options.paths.size() == 1 && !is_folder(options.paths.front()))
    return check_one(options.paths.front(), options.all, run.console);
  ManyReports reports(options.all, run.console);
  for (const std::string& path : options.paths) {
    if (!is_folder(path))
      reports.check(path, true);
    else
      for (const std::filesystem::path& file : json_files(path)) reports.check(file.string(), false);
  }
  return reports.finish();
}

}  // namespace

void add_check(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command =
      program.add("check", "Run the comparisons of reports again, or landmarks, and show what changed");
  command
      .paths("REPORT", options->paths,
             "Reports of compare or landmarks, or folders with such reports (.json)")
      .required();
  command.flag("--all", options->all, "Show every difference, not only the first 20 of a report");
  add_common_options(command, program.common, false);
  command.examples = {{"check report.json", "is what the report says still so?"},
                      {"check results/reports", "all reports of a folder, as of a batch"}};
  command.notes =
      "Meshes, and lists of marked ones, are looked for from the working folder, then from the report's "
      "folder. Timings and the "
      "program's version may differ; counts and texts may not, real numbers by no more than 1e-9 of "
      "themselves.\n\n"
      "Exit code: 0 if nothing changed, 1 if anything did, 3 if a report could not be checked.";
  set_action(program, command, options, check);
}

}  // namespace morsel::tools
