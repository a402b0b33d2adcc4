#pragma once
/// The JSON document of `morsel cut`: morsel.cut/1 (tools/report/cut.schema.json).

#include "morsel/tools/report/field_document.h"
#include "morsel/tools/study/cutting.h"

namespace morsel::tools {

/// The request.
struct CutRequest {
  FieldRequest field;
  bool shorten = true;
  core::BuildOptions build = {};
};

Json request_section(const CutRequest& request);

/// Writes the whole document. Vertices are in the input's numbers; "output" lists, for each vertex of the
/// written mesh after the input's, the input vertex that it copies. `timings` becomes the last member.
void write_cut_document(JsonSink& json, const CutRequest& request, const FieldSource& source,
                        const CutOutcome& outcome, const Timings& timings);

}  // namespace morsel::tools
