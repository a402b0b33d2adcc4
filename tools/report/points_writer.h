#pragma once
/// Chosen points as JSON: in a document of their own ("morsel.points/1", see points.schema.json) and in
/// reports.

#include <optional>
#include <string>

#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// What was asked for of a field, with "points" if points were.
Json request_section(const FieldRequest& field, const std::optional<PointsRequest>& points,
                     const core::BuildOptions& build);

/// Adds to an object that is begun: "spacing", "salience_scale" (with rank=salience), "candidates",
/// "too_near", "fill" (the field that filled up, if it was needed), "count", "note", "mean_percentile" and,
/// point by point, "points"; percentiles that were not asked for are null. `field`: the name of the field.
void write_points(JsonSink& json, const MadePoints& made, const core::LoadedMesh& loaded,
                  const std::string& field);

/// Writes the whole document. `timings` become its last member.
void write_points_document(JsonSink& json, const Json& request, const FieldSource& source,
                           const MadePoints& made, const Timings& timings);

}  // namespace morsel::tools
