#include "morsel/tools/report/report_check.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/landmarks_reader.h"
#include "morsel/tools/report/report_reader.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {
namespace {

/// The report that the same request gives now.
ReportDocument run_again(const LoadedReport& report, const std::filesystem::path& mesh_path,
                         const Registry& registry, const core::Progress& progress) {
  MeshOrigin file{mesh_path};
  if (!report.format.empty()) file.format = core::mesh_format_named(report.format);
  const ComparisonPlan plan = prepare(report.request, registry);
  const HashedMesh input = read_hashed_mesh(file, build_for(plan.function, report.build), progress);
  ReportCollector again;
  ReportWriter writer(again, input.loaded,
                      {report.mesh_path, input.sha256, report.build, report.items, 0, report.format},
                      report.request);
  run_comparison(input.loaded, plan, {&writer}, progress);
  writer.finish();
  return again.take();
}

/// `report` is a LoadedReport or LoadedLandmarks.
template <class Report>
void check_input(ReportCheck& result, const Report& report, const std::filesystem::path& path,
                 const Registry& registry, const core::Progress& progress) {
  const std::filesystem::path input = find_input(result.input_path, path);
  if (input.empty()) {
    result.input_is_missing = true;
    return;
  }
  try {
    result.differences = report_differences(report.document, run_again(report, input, registry, progress));
  } catch (const core::InvalidArgument& error) {
    throw core::BadInput(path.string() + " requests what this version does not support: " + error.what());
  }
}

}  // namespace

ReportCheck check_report(const std::filesystem::path& path, const core::Progress& progress,
                         const Registry& registry) {
  ReportCheck result;
  if (const std::optional<LoadedLandmarks> report = read_landmarks(path)) {
    result.is_of_landmarks = true;
    result.input_path = report->list_path;
    result.rows = report->document.head["rows"].size();
    check_input(result, *report, path, registry, progress);
  } else {
    const LoadedReport comparison = read_report(path);
    result.input_path = comparison.mesh_path;
    result.rows = comparison.request.methods.size();
    check_input(result, comparison, path, registry, progress);
  }
  return result;
}

std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file() && core::file_extension(at->path()) == ".json") files.push_back(at->path());
  if (error) throw core::BadInput("cannot read the folder " + folder.string() + ": " + error.message());
  if (files.empty()) throw core::BadInput("there is no report (.json) in the folder " + folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace morsel::tools
