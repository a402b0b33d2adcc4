#pragma once
/// Where a JSON document that the program wrote comes from, by what is in it.

#include <string>
#include <string_view>

#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// What a document of this schema is and which commands write it: "chosen critical points (morsel points,
/// morsel field)"; "a document of morsel" of one that is not known.
std::string described_schema(std::string_view schema);

/// Of a document's text: its own schema, tool, request and, where it has one, field; and inputs[] {path,
/// sha256}, the files that it names with their hashes, each once, in their order. Null if it is JSON that is
/// not of the program. Lists in it are not kept, so that it takes no more memory than their longest element.
/// It is untrusted: throws BadInput, naming it as `name`, if it is no JSON (json_reader.h) or lacks these
/// members.
Json document_origin(std::string_view text, const std::string& name);

}  // namespace morsel::tools
