#include "morsel/tools/report/report_writer.h"

#include <span>

#include "morsel/persistence/diagram.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/mesh_section.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/points_request.h"
#include "morsel/tools/report/points_writer.h"

namespace morsel::tools {
namespace {

Json matching_section(const Matching& matching) {
  return {{"kept", matching.kept.size()},
          {"moved", matching.moved.size()},
          {"added", matching.added},
          {"removed", matching.removed}};
}

}  // namespace

Json request_section(const ReportInput& input, const ComparisonRequest& request) {
  Json asked = {{"field", request.field}, {"methods", request.methods}, {"repair", input.build.repair}};
  add_build_options(asked, input.build);
  if (!input.format.empty()) asked["format"] = input.format;
  if (!input.items) asked["items"] = false;
  if (request.target) asked["target"] = *request.target;
  if (request.snap) asked["snap"] = true;
  if (request.points) asked["points"] = request_section(*request.points);
  return asked;
}

ReportWriter::ReportWriter(JsonSink& json, const core::LoadedMesh& loaded, const ReportInput& input,
                           const ComparisonRequest& request)
    : json_(json), loaded_(loaded), items_(input.items), timings_({{"load", input.load_seconds}}) {
  json_.begin_object();
  json_.member("schema", "morsel.comparison/1");
  json_.member("tool", tool_section());
  json_.member("request", request_section(input, request));
  json_.member("mesh", mesh_section(input.mesh_path, input.mesh_sha256, loaded));
}

void ReportWriter::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  json_.member("field", field_section(outcome));
  timings_["field"] = outcome.seconds;
  timings_["methods"] = Json::array();
  json_.begin_array("methods");
}

void ReportWriter::method(const MethodOutcome& outcome) {
  const Measurement& m = outcome.measurement;
  json_.begin_object();
  json_.member("name", outcome.name);
  add_members(steps_section(outcome.steps));
  if (outcome.target) write_target(*outcome.target);
  json_.member("field", {{"min", outcome.field.min()}, {"max", outcome.field.max()}});
  json_.member("critical_points", counts_section(m.critical_points));
  json_.member("ms_complex", complex_section(m.complex, m.segmentation, m.cells));
  json_.member("compared_to_first", matching_section(outcome.compared_to_first));
  write_persistence(outcome);
  if (items_) write_items(outcome);
  if (outcome.chosen) write_chosen(*outcome.chosen);
  json_.end_object();
  Json seconds = {{"name", outcome.name}};
  seconds.update(timings_section(outcome.timings));
  timings_["methods"].push_back(std::move(seconds));
}

void ReportWriter::add_members(const Json& section) {
  for (const auto& [key, value] : section.items()) json_.member(key, value);
}

void ReportWriter::write_target(const TargetOutcome& target) {
  json_.begin_object("target");
  add_members(target_section(target, loaded_.source.numbering));
  if (items_) {
    json_.begin_array("cancelled");
    json_.rows(target.cancelled.size(), [&](std::size_t i, const TakeRow& take) {
      const persistence::PersistencePair& pair = target.cancelled[i];
      take({{"kind", to_string(pair.kind)},
            {"extremum", loaded_.source.numbering.input_vertex(pair.extremum)},
            {"saddle", loaded_.source.numbering.input_vertex(pair.saddle)},
            {"persistence", pair.persistence()}});
    });
    json_.end_array();
  }
  json_.end_object();
}

void ReportWriter::write_persistence(const MethodOutcome& outcome) {
  json_.begin_object("persistence");
  add_members(persistence_section(outcome.measurement.diagram, outcome.input_extent));
  if (items_) write_diagram(outcome);
  json_.end_object();
}

void ReportWriter::write_diagram(const MethodOutcome& outcome) {
  using persistence::PairKind;
  const persistence::Diagram& diagram = outcome.measurement.diagram;
  json_.begin_array("diagram");
  const auto entry = [&](const TakeRow& take, std::string_view kind, double birth, double death,
                         core::Index born, core::Index dead) {
    const auto number = [&](core::Index v) {
      return v == core::kNone ? Cell(nullptr) : Cell(loaded_.source.numbering.input_vertex(v));
    };
    take({{"kind", kind},
          {"birth", birth},
          {"death", death},
          {"persistence", death - birth},
          {"birth_vertex", number(born)},
          {"death_vertex", number(dead)}});
  };
  json_.rows(diagram.pairs.size(), [&](std::size_t i, const TakeRow& take) {
    const persistence::PersistencePair& pair = diagram.pairs[i];
    const bool rising = pair.kind == PairKind::minimum_saddle;
    const core::Index other = pair.kind == PairKind::saddle_cap ? core::kNone : pair.extremum;
    entry(take, to_string(pair.kind), pair.birth, pair.death, rising ? other : pair.saddle,
          rising ? pair.saddle : other);
  });
  const TakeRow add = [&](Row row) { json_.row(row); };
  const auto essential = [&](std::string_view kind, core::Index v) {
    entry(add, kind, outcome.field.value(v), persistence::kInfinite, v, core::kNone);
  };
  for (const auto& extrema : diagram.essential_extrema) essential("essential-minimum", extrema.minimum);
  for (const auto& saddle : diagram.essential_saddles)
    for (core::Index i = 0; i < saddle.count; ++i) essential("essential-saddle", saddle.vertex);
  for (const auto& extrema : diagram.essential_extrema)
    if (!extrema.top_is_cap) essential("essential-maximum", extrema.top);
  json_.end_array();
}

void ReportWriter::write_items(const MethodOutcome& outcome) {
  const std::vector<double> persistence =
      persistence::vertex_persistence(outcome.measurement.diagram, loaded_.mesh.vertex_count());
  json_.begin_array("items");
  const std::vector<morse::CriticalPoint>& points = outcome.measurement.critical_points.points;
  json_.rows(points.size(), [&](std::size_t i, const TakeRow& take) {
    const morse::CriticalPoint& point = points[i];
    const core::Index origin = outcome.origins[i];
    const std::span<const double, 3> position(loaded_.mesh.position(outcome.places[i]).data(), 3);
    const bool lost = origin == core::kNone;
    const Cell from = lost ? Cell(nullptr) : Cell(loaded_.source.numbering.input_vertex(origin));
    const Cell moved =
        lost ? Cell(nullptr)
             : Cell((loaded_.mesh.position(point.vertex) - loaded_.mesh.position(origin)).norm());
    take({{"vertex", loaded_.source.numbering.input_vertex(point.vertex)},
          {"position", position},
          {"type", to_string(point.type)},
          {"multiplicity", point.multiplicity},
          {"value", outcome.field.value(point.vertex)},
          {"persistence", persistence[point.vertex]},
          {"origin", from},
          {"moved", moved}});
  });
  json_.end_array();
}

void ReportWriter::write_chosen(const ChosenOutcome& chosen) {
  json_.begin_object("chosen");
  write_points(json_, chosen.made, loaded_, field_name_);
  json_.member("compared_to_first", matching_section(chosen.compared_to_first));
  json_.end_object();
}

void ReportWriter::finish() {
  json_.end_array();
  timings_["total"] = watch_.seconds() + timings_["load"].get<double>();
  json_.member("timings", timings_);
  json_.end_object();
}

}  // namespace morsel::tools
