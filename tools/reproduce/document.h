#pragma once
/// The numbers of a reproduction as JSON: "morsel.reproduction/1", see tools/report/reproduction.schema.json.

#include "morsel/tools/report/json_stream.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools::reproduce {

void write_document(JsonSink& json, const Prepared& prepared, const Reproduction& reproduction);

}  // namespace morsel::tools::reproduce
