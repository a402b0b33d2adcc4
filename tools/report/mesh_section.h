#pragma once
/// The properties of a mesh in reports and `morsel info`.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// The report's "mesh": path as given, hash, counts, topology, size and repairs. Lengths in the
/// mesh's unit.
Json mesh_section(const std::filesystem::path& path, const std::string& sha256,
                  const core::TriangleMesh& mesh, const std::vector<core::Repair>& repairs);

/// [{"action": …, "count": …}, …]
Json repairs_section(const std::vector<core::Repair>& repairs);

}  // namespace morsel::tools
