#pragma once
/// A mesh with the hash of its file.

#include <filesystem>
#include <string>

#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

struct HashedMesh {
  core::LoadedMesh loaded;
  std::string sha256;
};

/// core::read_mesh() and, meanwhile, sha256_of_file().
HashedMesh read_hashed_mesh(const std::filesystem::path& path, const core::BuildOptions& options = {},
                            const core::Progress& progress = {});

struct HashedWholeMesh {
  core::WholeMesh input;
  std::string sha256;
};

/// core::read_whole_mesh() and, meanwhile, sha256_of_file().
HashedWholeMesh read_hashed_whole_mesh(const std::filesystem::path& path,
                                       const core::BuildOptions& options = {},
                                       const core::Progress& progress = {});

}  // namespace morsel::tools
