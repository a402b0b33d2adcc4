#include "morsel/tools/report/points_writer.h"

#include <cstdint>
#include <span>

#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/points_request.h"

namespace morsel::tools {

Json request_section(const FieldRequest& field, const std::optional<PointsRequest>& points,
                     const core::BuildOptions& build) {
  Json asked = request_section(field, build);
  if (points) asked["points"] = request_section(*points);
  return asked;
}

void write_points(JsonSink& json, const MadePoints& made, const core::LoadedMesh& loaded,
                  const std::string& field) {
  json.member("spacing", made.chosen.spacing);
  if (made.scale) json.member("salience_scale", *made.scale);
  json.member("candidates", made.candidates);
  json.member("too_near", made.chosen.too_near);
  if (made.fill) json.member("fill", field_section(*made.fill));
  json.member("count", made.chosen.points.size());
  json.member("note", made.note);
  const std::optional<double> mean = made.mean_percentile();
  json.member("mean_percentile", mean ? Json(*mean) : Json());
  json.begin_array("points");
  json.rows(made.chosen.points.size(), [&](std::size_t i, const TakeRow& take) {
    const auto& [candidate, list, distance] = made.chosen.points[i];
    const morse::CriticalPoint& point = candidate.point;
    const std::optional<double> percentile = made.percentile(i);
    const core::Point& at = loaded.mesh.position(made.places[i]);
    take({{"vertex", std::uint64_t{loaded.source.numbering.input_vertex(point.vertex)}},
          {"position", std::span<const double, 3>(at.data(), 3)},
          {"type", to_string(point.type)},
          {"multiplicity", std::uint64_t{point.multiplicity}},
          {"value", candidate.value},
          {"persistence", candidate.persistence},
          {"rank", candidate.rank},
          {"distance", distance},
          {"percentile", percentile ? Cell(*percentile) : Cell(nullptr)},
          {"field", std::string_view(list == 0 ? field : made.fill->name)}});
  });
  json.end_array();
}

void write_points_document(JsonSink& json, const Json& request, const FieldSource& source,
                           const MadePoints& made, const Timings& timings) {
  begin_field_document(json, "morsel.points/1", request, source);
  write_points(json, made, source.loaded, source.made.input.name);
  json.member("timings", timings_section(timings));
  json.end_object();
}

}  // namespace morsel::tools
