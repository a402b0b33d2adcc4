#pragma once
/// The properties of a mesh in reports and `morsel info`.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// The report's "mesh": path as given, hash, counts, topology, size, repairs, and "warnings" of reading if
/// there are any. Lengths in the mesh's unit.
Json mesh_section(const std::filesystem::path& path, const std::string& sha256,
                  const core::LoadedMesh& loaded);

/// [{"action": …, "count": …}, …]
Json repairs_section(const std::vector<core::Repair>& repairs);

}  // namespace morsel::tools
