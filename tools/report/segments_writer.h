#pragma once
/// The JSON table of a segmentation ("morsel.segments/1", see segments.schema.json).

#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/made_segments.h"

namespace morsel::tools {

/// The request.
struct SegmentsRequest {
  FieldRequest field;
  SegmentRequest segments;
  core::BuildOptions build = {};
};
Json request_section(const SegmentsRequest& request);

/// Writes the whole document, segment by segment. `timings` becomes its last member.
void write_segments(JsonSink& json, const SegmentsRequest& request, const FieldSource& source,
                    const MadeSegments& made, const Timings& timings);

}  // namespace morsel::tools
