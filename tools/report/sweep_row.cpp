#include "morsel/tools/report/sweep_row.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {
namespace {

core::ParameterValue read_value(const JsonView& value) {
  const Json& json = value.json();
  if (json.is_boolean()) return value.truth();
  if (json.is_string()) return value.text();
  if (json.is_number_integer())
    return value.integer(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();  // as to_json() writes it
  return value.number();
}

core::Parameters read_parameters(const JsonView& values) {
  core::Parameters parameters;
  for (const auto& [name, value] : values.members()) parameters.emplace_back(name, read_value(value));
  return parameters;
}

FieldSummary read_field(const JsonView& field) {
  check_field(field);
  FieldSummary summary{field["name"].text(), read_parameters(field["parameters"]), field["min"].number(),
                       field["max"].number()};
  if (const std::optional<JsonView> warnings = field.find("warnings"))
    for (const JsonView& warning : warnings->list(1)) summary.warnings.push_back(warning.text());
  return summary;
}

/// The parameters of a single step directly, of a chain as a list of its steps'.
std::vector<StepOutcome> read_steps(const JsonView& method) {
  const JsonView parameters = method["parameters"];
  const std::optional<JsonView> listed = parameters.find("steps");
  if (!listed || !listed->json().is_array())
    return {{method["name"].text(), read_parameters(parameters), {}, {}}};
  std::vector<StepOutcome> steps;
  for (const JsonView& step : listed->list(2))
    steps.push_back({step["name"].text(), read_parameters(step["values"]), {}, {}});
  return steps;
}

morse::CriticalPoints read_counts(const JsonView& points) {
  check_critical_points(points);
  return {{},
          points["minima"].count(),
          points["saddles"].count(),
          points["saddle_multiplicity"].count(),
          points["maxima"].count()};
}

PersistenceSummary read_persistence(const JsonView& persistence) {
  check_persistence(persistence);
  PersistenceSummary summary;
  summary.pairs = persistence["pairs"].count();
  summary.infinite_pairs = persistence["infinite_pairs"].count();
  summary.essential_saddles = persistence["essential_saddles"].count();
  if (const JsonView largest = persistence["max"]; !largest.is_null()) summary.largest = largest.number();
  const std::vector<JsonView> above = persistence["above"].list();
  for (std::size_t i = 0; i < summary.above.size(); ++i) summary.above[i] = above[i]["pairs"].count();
  return summary;
}

SweepSeconds read_seconds(const JsonView& seconds) {
  check_members(seconds, {"field", "method", "measuring"});
  return {seconds["field"].number(0), seconds["method"].number(0), seconds["measuring"].number(0)};
}

}  // namespace

Json row_section(const SweepRow& row, std::span<const HashedFile> known) {
  return {{"field", field_section(row.field, known)},
          {"method",
           {{"name", row.method_name()},
            {"parameters", parameters_section(row.steps)},
            {"min", row.min},
            {"max", row.max}}},
          {"iterations_run", row.iterations_run ? Json(*row.iterations_run) : Json()},
          {"critical_points", counts_section(row.critical_points)},
          {"persistence", persistence_section(row.persistence)}};
}

Json seconds_section(const SweepSeconds& seconds) {
  return {{"field", seconds.field}, {"method", seconds.method}, {"measuring", seconds.measuring}};
}

SweepRow read_row(const JsonView& row, const JsonView& seconds) {
  check_members(row, {"field", "method", "iterations_run", "critical_points", "persistence"});
  const JsonView method = row["method"];
  check_field(method);
  SweepRow read;
  read.field = read_field(row["field"]);
  read.steps = read_steps(method);
  if (method["name"].text() != read.method_name()) method["name"].refuse("is not that of its steps");
  read.min = method["min"].number();
  read.max = method["max"].number();
  if (const JsonView run = row["iterations_run"]; !run.is_null())
    read.iterations_run = static_cast<std::int64_t>(run.count());
  read.critical_points = read_counts(row["critical_points"]);
  read.persistence = read_persistence(row["persistence"]);
  read.seconds = read_seconds(seconds);
  return read;
}

}  // namespace morsel::tools
