#include "morsel/tools/report/report_reader.h"

#include <cerrno>
#include <system_error>

#include "morsel/core/io/file_bytes.h"
#include "morsel/core/parallel/exhaustion.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/points_request.h"

namespace morsel::tools {
namespace {

constexpr std::string_view kSchema = "morsel.comparison/1";

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

}  // namespace

std::ifstream open_report(const std::filesystem::path& path) {
  const std::string what = "cannot read the report " + path.string();
  core::check_regular_file(path, what);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) core::fail_to_read(errno, what);
  return in;
}

LoadedReport read_report(const std::filesystem::path& path) {
  std::ifstream in = open_report(path);
  return read_report(in, path.string());
}

LoadedReport read_report(std::istream& in, const std::string& name) {
  LoadedReport report;
  report.document = parse_report(in, name, kSchema);
  const Json& document = report.document.head;
  if (!document.is_object() || !document.contains("schema"))
    throw OtherDocument(name + " is not a comparison report: it has no schema");
  const JsonView head(document, name + " is a damaged report");
  const JsonView request = head["request"];
  report.request.field = request["field"].text();
  report.request.methods.clear();
  for (const JsonView& method : request["methods"].list(1, kMostMethods))
    report.request.methods.push_back(method.text());
  report.build = read_build_options(request);
  if (const auto format = request.find("format")) report.format = format->text();
  if (const auto items = request.find("items")) report.items = items->truth();
  if (const auto target = request.find("target")) report.request.target = target->count();
  if (const auto snap = request.find("snap")) report.request.snap = snap->truth();
  if (const auto points = request.find("points")) report.request.points = read_points_request(*points);
  report.mesh_path = head["mesh"]["path"].path();
  report.mesh_sha256 = head["mesh"]["sha256"].text();
  for (const JsonView& method : head["methods"].list(0, kMostMethods))
    static_cast<void>(method["name"].text());
  return report;
}

std::filesystem::path find_input(const std::filesystem::path& path,
                                 const std::filesystem::path& report_path) {
  if (is_file(path)) return path;
  const std::filesystem::path beside = report_path.parent_path() / path;
  return is_file(beside) ? beside : std::filesystem::path();
}

}  // namespace morsel::tools
