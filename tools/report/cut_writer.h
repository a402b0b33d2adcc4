#pragma once
/// The JSON document of `morsel cut`: morsel.cut/1 (tools/report/cut.schema.json).

#include <string>

#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/cutting/cutting.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/json_stream.h"

namespace morsel::tools {

/// What was asked for.
struct CutRequest {
  FieldRequest field;
  bool shorten = true;
  bool repair = false;
};

struct CutTimings {
  double load_seconds = 0;
  double write_seconds = 0;
};

/// Writes the whole document. Vertices are in the input's numbers; "output" tells which input vertex each
/// vertex of the written mesh copies that comes after the input's.
void write_cut_document(JsonSink& json, const std::string& mesh_path, const HashedMesh& input,
                        const CutRequest& request, const FieldRecipe& recipe, const MadeField& made,
                        const CutOutcome& outcome, const CutTimings& timings);

}  // namespace morsel::tools
