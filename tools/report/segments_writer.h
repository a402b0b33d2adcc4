#pragma once
/// The JSON table of a segmentation ("morsel.segments/1", see segments.schema.json).

#include <string>

#include "morsel/core/mesh_io.h"
#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/report/json_stream.h"
#include "morsel/tools/segmentation/made_segments.h"

namespace morsel::tools {

/// What the document says of its input and of what was asked for, in the words of the command line.
struct SegmentsInput {
  std::string mesh_path;
  std::string mesh_sha256;
  bool repair = false;
  FieldRequest field;
  SegmentRequest segments;
};

/// Writes the whole document, segment by segment. `timings` becomes its last member.
void write_segments(JsonSink& json, const SegmentsInput& input, const core::LoadedMesh& loaded,
                    const FieldRecipe& recipe, const MadeField& field, const MadeSegments& made,
                    const Timings& timings);

}  // namespace morsel::tools
