#include "morsel/tools/report/sweep_row.h"

#include <optional>
#include <string>

#include "morsel/tools/report/outcome_reading.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {
namespace {

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
