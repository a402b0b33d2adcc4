#pragma once
/// The numbers of a reproduction as JSON: "morsel.reproduction/1", see tools/report/reproduction.schema.json;
/// and the provenance of its files.

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools::reproduce {

/// Of a file that shows these models, without methods.
Provenance provenance_of(const Request& request, const std::vector<const Model*>& models);
/// Of the page, with all methods that were run.
Provenance page_provenance(const Prepared& prepared, const Reproduction& reproduction);

void write_document(JsonSink& json, const Prepared& prepared, const Reproduction& reproduction);

}  // namespace morsel::tools::reproduce
