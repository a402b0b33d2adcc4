#include "morsel/tools/batch/summary.h"

#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/tools/batch/page.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/version.h"

namespace morsel::tools::batch {
namespace {

/// Seconds of all steps of a method.
double method_seconds(const Json& timings, std::size_t i) {
  double sum = 0;
  for (const auto& [step, seconds] : timings.at("methods").at(i).items())
    if (seconds.is_number()) sum += seconds.get<double>();
  return sum;
}

/// Adds the rows of a mesh, one a method: counts and parameters are empty where there are none.
void add_rows(CsvTable& table, const MeshOutcome& outcome, const ComparisonRequest& request,
              bool with_timings) {
  const bool done = outcome.status == Status::done;
  const Json result = done ? outcome.state.result : Json();
  for (std::size_t i = 0; i < request.methods.size(); ++i) {
    const Json method = done ? result["methods"].at(i) : Json();
    CsvLine line;
    const auto add = [&](const Json& section, const char* key) {
      line.add_json(done ? section.at(key) : Json());
    };
    line.add_path(outcome.mesh.name);
    line.add_json(outcome.sha256);
    line.add(to_string(outcome.status));
    const Json mesh = done ? result["mesh"] : Json();
    for (const char* key :
         {"vertices", "edges", "faces", "components", "boundary_loops", "euler_characteristic", "genus"})
      add(mesh, key);
    line.add(request.methods[i]);
    const Json points = done ? method["critical_points"] : Json();
    for (const char* key : {"minima", "saddles", "saddle_multiplicity", "maxima", "total"}) add(points, key);
    line.add_json(done ? method["persistence"].at("pairs") : Json());
    line.add_json(done ? Json(pairs_over_one_percent(method)) : Json());
    if (with_timings) line.add_json(done ? Json(method_seconds(outcome.state.timings, i)) : Json());
    line.add(outcome.status == Status::failed ? outcome.state.error->message : "");
    line.add(kVersion);
    line.add(request.field);
    line.add_json(done ? result["field"].at("parameters") : Json());
    line.add_json(done ? method.at("parameters") : Json());
    table.add(line);
  }
}

void write_table(const core::FileTarget& target, const std::vector<MeshOutcome>& outcomes,
                 const ComparisonRequest& request, bool with_timings) {
  core::FileWriter file(target);
  std::vector<std::string> columns = {"mesh",
                                      "sha256",
                                      "status",
                                      "vertices",
                                      "edges",
                                      "faces",
                                      "components",
                                      "boundary_loops",
                                      "euler_characteristic",
                                      "genus",
                                      "method",
                                      "minima",
                                      "saddles",
                                      "saddle_multiplicity",
                                      "maxima",
                                      "total",
                                      "pairs",
                                      "pairs_over_1_percent"};
  if (with_timings) columns.emplace_back("seconds");
  for (const char* column : {"error", "version", "field", "field_parameters", "method_parameters"})
    columns.emplace_back(column);
  CsvTable table(file.stream(), columns);
  for (const MeshOutcome& outcome : outcomes) add_rows(table, outcome, request, with_timings);
  file.commit();
}

Json mesh_section(const MeshOutcome& outcome, const BatchRequest& request) {
  const std::string& name = outcome.mesh.name;
  Json section = {{"name", name}, {"sha256", outcome.sha256}, {"status", to_string(outcome.status)}};
  if (outcome.status == Status::failed) {
    section["error"] = to_json(*outcome.state.error);
    section["limits"] = to_json(outcome.state.limits);
  }
  if (outcome.status != Status::done) return section;
  const OutFolder beside;
  section["report"] = beside.report(name).generic_string();
  if (request.thumbnails)
    section["thumbnails"] = {beside.thumbnail(name, "first").generic_string(),
                             beside.thumbnail(name, "last").generic_string()};
  if (request.pages) section["page"] = beside.page(name).generic_string();
  if (request.figures) section["figures"] = beside.figures(name).generic_string();
  if (request.exports) section["exports"] = beside.exports(name).generic_string();
  for (const char* key : {"mesh", "field", "methods"}) section[key] = outcome.state.result.at(key);
  section["mesh"].erase("sha256");
  return section;
}

void write_document(const core::FileTarget& target, const std::vector<MeshOutcome>& outcomes,
                    const BatchRequest& request, const SummaryOptions& options) {
  core::FileWriter file(target);
  JsonStream json(file.stream());
  json.begin_object();
  json.member("schema", "morsel.batch/1");
  const Json key = common_key(request);
  json.member("tool", key.at("tool"));
  json.member("collection", options.collection);
  json.member("request", key.at("request"));
  json.member("files", key.at("files"));
  const Tally sums = tally(outcomes);
  json.member(
      "counts",
      {{"meshes", outcomes.size()}, {"done", sums.done}, {"failed", sums.failed}, {"not_run", sums.not_run}});
  json.begin_array("meshes");
  for (const MeshOutcome& outcome : outcomes) {
    json.begin_object();
    const Json section = mesh_section(outcome, request);
    for (const auto& [name, value] : section.items()) json.member(name, value);
    json.end_object();
  }
  json.end_array();
  json.begin_array("timings");
  for (const MeshOutcome& outcome : outcomes) {
    if (outcome.status == Status::not_run) continue;
    json.begin_object();
    json.member("name", outcome.mesh.name);
    json.member("seconds", outcome.state.seconds);
    if (outcome.status == Status::done) json.member("report", outcome.state.timings);
    json.end_object();
  }
  json.end_array();
  json.end_object();
  file.commit();
}

}  // namespace

Tally tally(const std::vector<MeshOutcome>& outcomes) {
  Tally sums;
  for (const MeshOutcome& outcome : outcomes) {
    sums.done += outcome.status == Status::done;
    sums.failed += outcome.status == Status::failed;
    sums.not_run += outcome.status == Status::not_run;
    sums.settled += outcome.was_settled;
  }
  return sums;
}

std::string to_string(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    case Status::not_run:
      break;
  }
  return "not-run";
}

std::size_t pairs_over_one_percent(const Json& method) {
  for (const Json& share : method.at("persistence").at("above"))
    if (share.at("percent") == 1.0) return share.at("pairs").get<std::size_t>();
  throw core::BadInput("a report without its number of pairs over 1 %");
}

void write_summary(const std::vector<MeshOutcome>& outcomes, const BatchRequest& request,
                   const SummaryOptions& options, ResultFolder& out) {
  write_table(out.claim("summary.csv"), outcomes, request.comparison, options.with_timings);
  write_document(out.claim("summary.json"), outcomes, request, options);
  write_page(outcomes, request, options, out);
}

void check_summary(ResultFolder& out) {
  for (const char* file : {"summary.csv", "summary.json", "index.html", "plots/histogram.svg",
                           "plots/cumulative.svg", "plots/against-size.svg"})
    out.check_free(file);
}

}  // namespace morsel::tools::batch
