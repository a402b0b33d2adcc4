#pragma once
/// Chosen points as a JSON document ("morsel.points/1", see points.schema.json).

#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// How points were to be chosen, without their number: {"kind", "rank", "spacing", "fill", "scale"}, the last
/// two if they were given; in the syntax of the command line.
Json choice_section(const PointsRequest& points);

/// What was asked for.
Json request_section(const FieldRequest& field, const PointsRequest& points, bool repair);

/// Writes the whole document, point by point. `timings` becomes its last member.
void write_points_document(JsonSink& json, const Json& request, const FieldSource& source,
                           const MadePoints& made, const Timings& timings);

}  // namespace morsel::tools
