#pragma once
/// The head that every JSON document about what is built on one field has.

#include <string>
#include <string_view>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// What a field was made from; refers to all of it.
struct FieldSource {
  const HashedFile& mesh;
  const core::LoadedMesh& loaded;
  const FieldPlan& plan;
  const MadeField& made;
};

/// {"field", "method", "repair", "target" (if there is one)}: in the words of the command line.
Json request_section(const FieldRequest& request, bool repair);

/// Begins a document: "schema", "tool", "request", "mesh", "field", "method". The caller adds what is its own
/// and ends it.
void begin_field_document(JsonSink& json, std::string_view schema, const Json& request,
                          const FieldSource& source);

}  // namespace morsel::tools
