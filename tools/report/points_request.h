#pragma once
/// What points were to be chosen, as a section of documents.

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// How points were to be chosen: {"kind", "rank", "spacing", "fill", "scale" (if there are such)}, in the
/// syntax of the command line.
Json choice_section(const PointsRequest& points);
/// All that was asked for: also "count" and "percentiles".
Json request_section(const PointsRequest& points);

/// A length in the syntax of the command line; throws BadInput on other texts.
core::Length read_length(const JsonView& text);

/// Read these back; throw BadInput on anything else. read_choice() leaves the rest at its defaults.
PointsRequest read_choice(const JsonView& section);
PointsRequest read_points_request(const JsonView& section);

}  // namespace morsel::tools
