#include "morsel/tools/batch/summary.h"

#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/tools/batch/page.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/version.h"

namespace morsel::tools::batch {
namespace {

/// A number or text of a report as a field of the table.
std::string field_of(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? csv_field(value.get<std::string>()) : value.dump();
}

/// Seconds of all steps of a method.
double method_seconds(const Json& timings, std::size_t i) {
  double sum = 0;
  for (const auto& [step, seconds] : timings.at("methods").at(i).items())
    if (seconds.is_number()) sum += seconds.get<double>();
  return sum;
}

/// The rows of a mesh, one a method: counts and parameters are empty where there are none.
std::string csv_rows(const MeshOutcome& outcome, const ComparisonRequest& request, bool with_timings) {
  const std::vector<std::string>& methods = request.methods;
  const bool done = outcome.status == Status::done;
  std::string rows;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    std::vector<std::string> fields = {csv_path(outcome.mesh.name), field_of(outcome.sha256),
                                       to_string(outcome.status)};
    const Json result = done ? outcome.state.result : Json();
    for (const char* key :
         {"vertices", "edges", "faces", "components", "boundary_loops", "euler_characteristic", "genus"})
      fields.push_back(done ? field_of(result["mesh"].at(key)) : "");
    fields.push_back(csv_field(methods[i]));
    const Json method = done ? result["methods"].at(i) : Json();
    for (const char* key : {"minima", "saddles", "saddle_multiplicity", "maxima", "total"})
      fields.push_back(done ? field_of(method["critical_points"].at(key)) : "");
    fields.push_back(done ? field_of(method["persistence"].at("pairs")) : "");
    fields.push_back(done ? std::to_string(pairs_over_one_percent(method)) : "");
    if (with_timings) fields.push_back(done ? Json(method_seconds(outcome.state.timings, i)).dump() : "");
    fields.push_back(outcome.status == Status::failed ? csv_field(outcome.state.error->message) : "");
    fields.insert(fields.end(), {kVersion, csv_field(request.field)});
    fields.push_back(done ? csv_field(json_text(result["field"].at("parameters"))) : "");
    fields.push_back(done ? csv_field(json_text(method.at("parameters"))) : "");
    for (std::size_t k = 0; k < fields.size(); ++k) rows += (k == 0 ? "" : ",") + fields[k];
    rows += '\n';
  }
  return rows;
}

void write_table(const core::FileTarget& target, const std::vector<MeshOutcome>& outcomes,
                 const ComparisonRequest& request, bool with_timings) {
  core::FileWriter file(target);
  file.write(
      "mesh,sha256,status,vertices,edges,faces,components,boundary_loops,euler_characteristic,genus,method,"
      "minima,saddles,saddle_multiplicity,maxima,total,pairs,pairs_over_1_percent,");
  file.write(with_timings ? "seconds," : "");
  file.write("error,version,field,field_parameters,method_parameters\n");
  for (const MeshOutcome& outcome : outcomes) file.write(csv_rows(outcome, request, with_timings));
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
