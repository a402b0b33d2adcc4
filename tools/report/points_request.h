#pragma once
/// What points were to be chosen, as a section of documents.

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// {"count", "kind", "rank", "spacing", "percentiles", "fill", "scale" (if there are such)}: in the syntax of
/// the command line.
Json request_section(const PointsRequest& points);
/// Reads that back; throws BadInput on anything else.
PointsRequest read_points_request(const JsonView& section);

}  // namespace morsel::tools
