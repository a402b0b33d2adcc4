#include "morsel/tools/report/points_writer.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/report/outcome_sections.h"

namespace morsel::tools {
namespace {

/// The one of these values that the text names.
template <class Values>
auto named(const JsonView& text, const Values& values) {
  const auto found =
      std::ranges::find_if(values, [&](auto value) { return to_string(value) == text.text(); });
  if (found == values.end()) text.refuse("has another value than this version knows");
  return *found;
}

core::Length length(const JsonView& text) {
  try {
    return core::parse_length(text.text(), "it");
  } catch (const core::InvalidArgument&) {
    text.refuse("is not a length");
  }
}

}  // namespace

Json request_section(const PointsRequest& points) {
  Json asked = {{"count", points.count},
                {"kind", to_string(points.kind)},
                {"rank", to_string(points.rank)},
                {"spacing", core::to_string(points.spacing)},
                {"percentiles", points.percentiles}};
  if (points.fill) asked["fill"] = *points.fill;
  if (points.scale) asked["scale"] = core::to_string(*points.scale);
  return asked;
}

PointsRequest read_points_request(const JsonView& section) {
  PointsRequest points;
  points.count = section["count"].count();
  points.kind = named(section["kind"], morse::kPointKinds);
  points.rank = named(section["rank"], morse::kPointRanks);
  points.spacing = length(section["spacing"]);
  points.percentiles = section["percentiles"].truth();
  if (const auto fill = section.find("fill")) points.fill = fill->text();
  if (const auto scale = section.find("scale")) points.scale = length(*scale);
  return points;
}

Json request_section(const FieldRequest& field, const std::optional<PointsRequest>& points, bool repair) {
  Json asked = request_section(field, repair);
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
