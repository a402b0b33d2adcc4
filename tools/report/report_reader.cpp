#include "morsel/tools/report/report_reader.h"

#include <fstream>

namespace morsel::tools {

LoadedReport read_report(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw core::BadInput("cannot read the report " + path.string());
  LoadedReport report;
  try {
    report.document = parse_report(in);
  } catch (const Json::parse_error& error) {
    throw core::BadInput(path.string() + " is not JSON: " + error.what());
  }
  const Json& head = report.document.head;
  const bool has_schema = head.is_object() && head.contains("schema") && head["schema"].is_string();
  const std::string schema = has_schema ? head["schema"].get<std::string>() : "none";
  if (schema != "morsel.comparison/1")
    throw OtherDocument(path.string() + " is not a comparison report: its schema is \"" + schema +
                        "\", not \"morsel.comparison/1\"");
  try {
    const Json& request = head.at("request");
    report.request.field = request.at("field").get<std::string>();
    report.request.methods = request.at("methods").get<std::vector<std::string>>();
    report.repair = request.at("repair").get<bool>();
    report.items = request.value("items", true);
    if (request.contains("target")) report.request.target = request.at("target").get<std::size_t>();
    report.request.snap = request.value("snap", false);
    report.mesh_path = head.at("mesh").at("path").get<std::string>();
    report.mesh_sha256 = head.at("mesh").at("sha256").get<std::string>();
  } catch (const Json::exception& error) {
    throw core::BadInput(path.string() + " is a damaged report: " + error.what());
  }
  if (report.request.methods.empty())
    throw core::BadInput(path.string() + " is a damaged report: it has no method");
  return report;
}

std::filesystem::path find_mesh(const LoadedReport& report, const std::filesystem::path& report_path) {
  const std::filesystem::path path = report.mesh_path;
  if (std::filesystem::is_regular_file(path)) return path;
  const std::filesystem::path beside = report_path.parent_path() / path;
  return std::filesystem::is_regular_file(beside) ? beside : std::filesystem::path();
}

}  // namespace morsel::tools
