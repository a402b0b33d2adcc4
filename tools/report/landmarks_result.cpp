#include "morsel/tools/report/landmarks_result.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "morsel/core/types.h"
#include "morsel/tools/report/outcome_reading.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

std::string method_name(const LandmarkRow& row) {
  std::string name;
  for (const StepOutcome& step : row.steps) name += (name.empty() ? "" : "+") + step.name;
  return name;
}

Json set_section(const MarkScore& score) {
  return {{"points", score.points()},
          {"marks_hit", score.marks_hit},
          {"points_hit", score.points_hit},
          {"matched", score.one_to_one.matched},
          {"distances", score.one_to_one.distances},
          {"detected", score.detected},
          {"detected_within", score.detected_within}};
}

Json landmark_section(const LandmarkRow& row, std::span<const HashedFile> known) {
  Json section = Json::object();
  if (!row.steps.empty())
    section["method"] = {{"name", method_name(row)},
                         {"parameters", parameters_section(row.steps)},
                         {"min", row.min},
                         {"max", row.max}};
  if (row.fill) section["fill"] = field_section(*row.fill, known);
  if (row.scale) section["salience_scale"] = *row.scale;
  if (!row.warnings.empty()) section["warnings"] = row.warnings;
  if (!row.note.empty()) section["note"] = row.note;
  if (!row.points.empty()) section["points"] = row.points;
  const auto mean = [&](const auto& quantity) { return row.mean(quantity); };
  section["recall"] = mean([](const MarkScore& score) { return score.recall(); });
  section["precision"] = mean([](const MarkScore& score) { return score.precision(); });
  section["f_score"] = mean([](const MarkScore& score) { return score.f_score(); });
  section["one_to_one"] = {
      {"recall", mean([](const MarkScore& score) { return score.one_to_one.recall(); })},
      {"precision", mean([](const MarkScore& score) { return score.one_to_one.precision(); })},
      {"f_score", mean([](const MarkScore& score) { return score.one_to_one.f_score(); })}};
  section["false_negatives"] = mean([](const MarkScore& score) { return score.false_negatives(); });
  section["false_positives"] = mean([](const MarkScore& score) { return score.false_positives(); });
  section["sets"] = Json::array();
  for (const MarkScore& score : row.sets) section["sets"].push_back(set_section(score));
  return section;
}

std::vector<std::string> read_texts(const JsonView& list) {
  std::vector<std::string> texts;
  for (const JsonView& text : list.list(1)) texts.push_back(text.text());
  return texts;
}

MarkScore read_set(const JsonView& set, std::size_t marks, std::size_t wanted) {
  MarkScore score;
  score.one_to_one.reference = marks;
  score.one_to_one.found = set["points"].count(wanted);
  const std::size_t pairs = std::min(marks, score.points());
  score.marks_hit = set["marks_hit"].count(marks);
  score.points_hit = set["points_hit"].count(score.points());
  score.one_to_one.matched = set["matched"].count(std::min(score.marks_hit, score.points_hit));
  score.one_to_one.distances = set["distances"].number(0);
  score.detected = set["detected"].count(pairs);
  constexpr std::size_t kRadii = LandmarksPlan::kCurveSteps + 1;
  std::size_t before = 0;
  for (const JsonView& detected : set["detected_within"].list(kRadii, kRadii)) {
    score.detected_within.push_back(detected.count(pairs));
    if (score.detected_within.back() < before) detected.refuse("is less than within a smaller radius");
    before = score.detected_within.back();
  }
  return score;
}

LandmarkRow read_landmark_row(const JsonView& section, std::size_t row, const LandmarksOnMesh& result,
                              const LandmarksPlan& plan) {
  LandmarkRow read;
  if (row < plan.made_rows()) {
    const JsonView method = section["method"];
    read.steps = read_steps(method);
    read.min = method["min"].number();
    read.max = method["max"].number();
  }
  if (const auto fill = section.find("fill")) read.fill = read_field(*fill);
  if (const auto scale = section.find("salience_scale")) read.scale = scale->number(0);
  if (const auto warnings = section.find("warnings")) read.warnings = read_texts(*warnings);
  if (const auto note = section.find("note")) read.note = note->text();
  const std::size_t sets = plan.sets_of(row);
  for (const JsonView& set : section["sets"].list(sets, sets))
    read.sets.push_back(read_set(set, result.marks, result.wanted));
  if (const auto points = section.find("points"))
    for (const JsonView& point : points->list(1, read.sets.front().points()))
      read.points.push_back(static_cast<core::Index>(point.count(core::kNone - 1)));
  const bool has_points = sets == 1;  // a single set
  if (read.points.size() != (has_points ? read.sets.front().points() : 0))
    section.refuse("does not list as many points as it has");
  return read;
}

}  // namespace

Json result_section(const LandmarksOnMesh& result, const LandmarksPlan& plan,
                    std::span<const HashedFile> known) {
  Json section = {{"marked", result.marks},
                  {"wanted", result.wanted},
                  {"radius", result.radius},
                  {"spacing", result.spacing}};
  if (!result.warnings.empty()) section["warnings"] = result.warnings;
  section["fields"] = Json::array();
  for (const FieldSummary& field : result.fields) section["fields"].push_back(field_section(field, known));
  section["rows"] = Json::array();
  for (std::size_t row = 0; row < result.rows.size(); ++row) {
    Json named = {{"row", plan.name_of(row)}};
    named.update(landmark_section(result.rows[row], known));
    section["rows"].push_back(std::move(named));
  }
  return section;
}

LandmarksOnMesh read_result(const JsonView& section, const LandmarksPlan& plan) {
  LandmarksOnMesh result;
  result.marks = section["marked"].count(core::kNone);
  if (result.marks == 0) section["marked"].refuse("is 0");
  result.wanted = section["wanted"].count();
  result.radius = section["radius"].number(0);
  result.spacing = section["spacing"].number(0);
  if (const auto warnings = section.find("warnings")) result.warnings = read_texts(*warnings);
  const std::size_t fields = plan.functions.size();
  for (const JsonView& field : section["fields"].list(fields, fields))
    result.fields.push_back(read_field(field));
  const std::vector<JsonView> rows = section["rows"].list(plan.rows(), plan.rows());
  for (std::size_t row = 0; row < rows.size(); ++row)
    result.rows.push_back(read_landmark_row(rows[row], row, result, plan));
  return result;
}

}  // namespace morsel::tools
