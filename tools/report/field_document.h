#pragma once
/// The head of every JSON document of a result that is built on one field.

#include <string>
#include <string_view>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// The origin of a field; refers to all of it.
struct FieldSource {
  const HashedFile& mesh;
  const core::LoadedMesh& loaded;
  const FieldPlan& plan;
  const MadeField& made;
};

/// {"field", "method", "repair", "weld", "mask" and "target" (if there is one)}: in the syntax of the command
/// line.
Json request_section(const FieldRequest& request, const core::BuildOptions& build);

/// Begins a document: "schema", "tool", "request", "mesh", "field", "method". The caller adds its own members
/// and ends it.
void begin_field_document(JsonSink& json, std::string_view schema, const Json& request,
                          const FieldSource& source);

}  // namespace morsel::tools
