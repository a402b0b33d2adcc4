#pragma once
/// The JSON document of a quadrangulation.

#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/quadrangulation.h"

namespace morsel::tools {

/// The request.
struct QuadsRequest {
  FieldRequest field;
  QuadRequest quads;
  core::BuildOptions build = {};
};
Json request_section(const QuadsRequest& request);

/// Writes the document, "morsel.quads/1" (quads.schema.json describes it). Vertices are those of the input
/// file. `timings` becomes its last member.
void write_quads(JsonSink& json, const QuadsRequest& request, const FieldSource& source,
                 const Quadrangulation& result, const Timings& timings);

}  // namespace morsel::tools
