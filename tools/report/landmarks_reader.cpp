#include "morsel/tools/report/landmarks_reader.h"

#include <cstdint>
#include <fstream>
#include <limits>
#include <utility>

#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/landmarks_writer.h"
#include "morsel/tools/report/points_request.h"
#include "morsel/tools/report/report_reader.h"

namespace morsel::tools {
namespace {

std::vector<std::string> texts_of(const JsonView& list) {
  std::vector<std::string> texts;
  for (const JsonView& text : list.list(1, kMostMethods)) texts.push_back(text.text());
  return texts;
}

LandmarksRequest request_of(const JsonView& asked) {
  LandmarksRequest request;
  request.fields = texts_of(asked["fields"]);
  request.methods = texts_of(asked["methods"]);
  if (const JsonView points = asked["points"]; !points.is_null()) request.count = points.count();
  request.choice = read_choice(asked);
  request.radius = read_length(asked["radius"]);
  request.largest_radius = read_length(asked["largest_radius"]);
  request.first = asked["first"].count(1);
  request.resamples = asked["resamples"].count(kMostResamples);
  request.seed = asked["seed"].count(std::numeric_limits<std::uint64_t>::max());
  return request;
}

}  // namespace

std::optional<LoadedLandmarks> read_landmarks(const std::filesystem::path& path) {
  std::ifstream in = open_report(path);
  return read_landmarks(in, path.string());
}

std::optional<LoadedLandmarks> read_landmarks(std::istream& in, const std::string& name) {
  LoadedLandmarks report;
  try {
    report.document = parse_report(in, name, kLandmarksSchema);
  } catch (const OtherDocument&) {
    return std::nullopt;
  }
  if (!report.document.head.is_object() || !report.document.head.contains("schema")) return std::nullopt;
  const JsonView head(report.document.head, name + " is a damaged report");
  report.request = request_of(head["request"]);
  report.build = read_build_options(head["request"]);
  report.list_path = head["list"]["path"].path();
  return report;
}

ReportDocument run_again(const LoadedLandmarks& report, const std::filesystem::path& list,
                         const Registry& registry, const core::Progress& progress) {
  const LandmarksPlan plan = prepare(report.request, registry);
  MarkedFiles files(list, report.request.first, build_for(plan.functions, report.build));
  const std::vector<HashedFile> field_files = input_files(fields_of(report.request), registry);
  const std::vector<LandmarksOnMesh> meshes = run_landmarks(files, plan, progress);
  ReportCollector again;
  write_landmarks(again, {files, plan, meshes, summarize(plan, meshes), field_files, 0});
  ReportDocument document = again.take();
  document.head["list"]["path"] = report.list_path;
  return document;
}

}  // namespace morsel::tools
