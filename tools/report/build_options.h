#pragma once
/// How a mesh was made of its file, in requests: "repair", "weld" if vertices were joined, and "mask" if a
/// mask left vertices out.

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/json_view.h"

namespace morsel::tools {

/// Adds "weld", a length such as "8eps", and "mask", as --mask takes it, where they were given.
void add_build_options(Json& request, const core::BuildOptions& build);

/// All three, of a request that is read back.
core::BuildOptions read_build_options(const JsonView& request);

}  // namespace morsel::tools
