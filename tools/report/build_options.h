#pragma once
/// How a mesh was made of its file, in requests: "repair", and "weld" if vertices were joined.

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/json_view.h"

namespace morsel::tools {

/// Adds "weld", a length such as "8eps", unless vertices were not to be joined.
void add_welding(Json& request, const core::BuildOptions& build);

/// Both, of a request that is read back.
core::BuildOptions read_build_options(const JsonView& request);

}  // namespace morsel::tools
