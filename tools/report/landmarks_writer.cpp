#include "morsel/tools/report/landmarks_writer.h"

#include <string>
#include <utility>

#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/landmarks_result.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/points_request.h"

namespace morsel::tools {
namespace {

Json mean_section(const MeshMean& mean) {
  return {{"mean", mean.mean},
          {"interval", mean.interval ? Json{mean.interval->low, mean.interval->high} : Json()}};
}

/// {"field", "method"} of a row, or {"chance"}.
Json origin_section(const LandmarksPlan& plan, std::size_t row) {
  if (row >= plan.made_rows()) return {{"chance", plan.name_of(row)}};
  return {{"field", plan.functions[plan.field_of(row)].specification},
          {"method", plan.chains[plan.method_of(row)].specification}};
}

Json summary_section(const LandmarksPlan& plan, std::size_t row, const LandmarksSummary& sum) {
  Json section = {{"row", plan.name_of(row)}};
  section.update(origin_section(plan, row));
  section["points"] = mean_section(sum.points);
  section["fewer_points"] = sum.fewer;
  section["recall"] = mean_section(sum.recall);
  section["precision"] = mean_section(sum.precision);
  section["f_score"] = mean_section(sum.f_score);
  section["f_score_gain"] = mean_section(sum.f_score_gain);
  section["one_to_one"] = {{"recall", mean_section(sum.matched_recall)},
                           {"precision", mean_section(sum.matched_precision)},
                           {"f_score", mean_section(sum.matched_f_score)},
                           {"distance", sum.distance ? Json(*sum.distance) : Json()}};
  section["false_negatives"] = mean_section(sum.false_negatives);
  section["false_positives"] = mean_section(sum.false_positives);
  section["within"] = {{"false_negatives", sum.false_negatives_within},
                       {"false_positives", sum.false_positives_within}};
  return section;
}

Json scoring_section(const LandmarksPlan& plan) {
  Json radii = Json::array();
  for (std::size_t step = 0; step <= LandmarksPlan::kCurveSteps; ++step)
    radii.push_back(core::to_string({plan.curve_radius(step), plan.request.largest_radius.unit}));
  return {{"radii", std::move(radii)}, {"random_sets", kPlacements}, {"confidence", kConfidence}};
}

void add_scores(CsvLine& line, const LandmarkRow& row) {
  line.add(row.mean([](const MarkScore& score) { return static_cast<double>(score.points()); }));
  line.add(row.mean([](const MarkScore& score) { return score.recall(); }));
  line.add(row.mean([](const MarkScore& score) { return score.precision(); }));
  line.add(row.mean([](const MarkScore& score) { return score.f_score(); }));
  line.add(row.mean([](const MarkScore& score) { return score.one_to_one.recall(); }));
  line.add(row.mean([](const MarkScore& score) { return score.one_to_one.precision(); }));
  line.add(row.mean([](const MarkScore& score) { return score.one_to_one.f_score(); }));
  line.add(row.mean([](const MarkScore& score) { return score.false_negatives(); }));
  line.add(row.mean([](const MarkScore& score) { return score.false_positives(); }));
}

}  // namespace

std::vector<HashedFile> LandmarksReport::inputs() const {
  std::vector<HashedFile> inputs = files.inputs();
  inputs.insert(inputs.end(), field_files.begin(), field_files.end());
  return inputs;
}

std::vector<std::string> fields_of(const LandmarksRequest& request) {
  std::vector<std::string> fields = request.fields;
  if (request.choice.fill) fields.push_back(*request.choice.fill);
  return fields;
}

Json request_section(const LandmarksRequest& request, const core::BuildOptions& build) {
  Json asked = {{"fields", request.fields},
                {"methods", request.methods},
                {"points", request.count ? Json(*request.count) : Json()}};
  asked.update(choice_section(request.choice));
  asked["radius"] = core::to_string(request.radius);
  asked["largest_radius"] = core::to_string(request.largest_radius);
  asked["first"] = request.first;
  asked["resamples"] = request.resamples;
  asked["seed"] = request.seed;
  asked["repair"] = build.repair;
  add_build_options(asked, build);
  return asked;
}

Json landmarks_key(const LandmarksRequest& request, const core::BuildOptions& build,
                   const std::vector<HashedFile>& field_files) {
  Json asked = request_section(request, build);
  asked.erase("resamples");
  return {{"schema", kLandmarksSchema},
          {"tool", tool_section()},
          {"request", std::move(asked)},
          {"files", files_section(field_files)}};
}

void write_landmarks(JsonSink& json, const LandmarksReport& report) {
  const LandmarksPlan& plan = report.plan;
  json.begin_object();
  json.member("schema", kLandmarksSchema);
  json.member("tool", tool_section());
  json.member("request", request_section(plan.request, report.files.build()));
  json.member("list", {{"path", report.files.list().path}, {"sha256", report.files.list().sha256}});
  json.member("matching", scoring_section(plan));
  json.begin_array("rows");
  for (std::size_t row = 0; row < report.summaries.size(); ++row) {
    json.begin_object();
    const Json section = summary_section(plan, row, report.summaries[row]);
    for (const auto& [key, value] : section.items()) json.member(key, value);
    json.end_object();
  }
  json.end_array();
  json.begin_array("meshes");
  Json seconds = Json::array();
  for (std::size_t i = 0; i < report.meshes.size(); ++i) {
    Json section = report.files.section(i);
    section.update(result_section(report.meshes[i], plan, report.field_files));
    json.begin_object();
    for (const auto& [key, value] : section.items()) json.member(key, value);
    json.end_object();
    seconds.push_back(report.meshes[i].seconds);
  }
  json.end_array();
  json.member("timings", {{"meshes", std::move(seconds)}, {"total", report.seconds}});
  json.end_object();
}

void write_landmarks_csv(std::ostream& out, const LandmarksReport& report) {
  CsvTable table(out, {"version",
                       "mesh",
                       "sha256",
                       "marks_file",
                       "marks_sha256",
                       "seed",
                       "radius",
                       "spacing",
                       "kind",
                       "rank",
                       "field",
                       "field_parameters",
                       "method",
                       "method_parameters",
                       "fill_parameters",
                       "marks",
                       "wanted",
                       "points",
                       "recall",
                       "precision",
                       "f_score",
                       "matched_recall",
                       "matched_precision",
                       "matched_f_score",
                       "false_negatives",
                       "false_positives"});
  const LandmarksPlan& plan = report.plan;
  for (std::size_t i = 0; i < report.meshes.size(); ++i) {
    const LandmarksOnMesh& mesh = report.meshes[i];
    const Json files = report.files.section(i);
    for (std::size_t row = 0; row < mesh.rows.size(); ++row) {
      const LandmarkRow& made = mesh.rows[row];
      const bool is_chance = row >= plan.made_rows();
      CsvLine line;
      line.add(kVersion);
      line.add_path(files["mesh"]["path"].get<std::string>());
      line.add(files["mesh"]["sha256"].get<std::string>());
      line.add_path(files["marks"]["path"].get<std::string>());
      line.add(files["marks"]["sha256"].get<std::string>());
      line.add(std::uint64_t{plan.request.seed});
      line.add(mesh.radius);
      line.add(mesh.spacing);
      line.add(is_chance ? "" : to_string(plan.request.choice.kind));
      line.add(is_chance ? "" : to_string(plan.request.choice.rank));
      line.add(is_chance ? plan.name_of(row) : plan.functions[plan.field_of(row)].specification);
      line.add_json(is_chance ? Json()
                              : field_parameters(mesh.fields[plan.field_of(row)], report.field_files));
      line.add(is_chance ? "" : plan.chains[plan.method_of(row)].specification);
      line.add_json(is_chance ? Json() : parameters_section(made.steps));
      line.add_json(made.fill ? field_parameters(*made.fill, report.field_files) : Json());
      line.add(std::uint64_t{mesh.marks});
      line.add(std::uint64_t{mesh.wanted});
      add_scores(line, made);
      table.add(line);
    }
  }
}

}  // namespace morsel::tools
