#pragma once
/// The JSON document of a quadrangulation.

#include <string>

#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/quads/quadrangulation.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/json_stream.h"

namespace morsel::tools {

/// What a quadrangulation was made from.
struct QuadsInput {
  std::string path;
  bool repair = false;
  double load_seconds = 0;
  FieldRequest field;
  QuadRequest quads;
};

/// Writes the document, "morsel.quads/1" (quads.schema.json describes it). Vertices are those of the input
/// file.
void write_quads(JsonSink& json, const QuadsInput& input, const HashedMesh& mesh, const FieldRecipe& recipe,
                 const MadeField& made, const Quadrangulation& result);

}  // namespace morsel::tools
