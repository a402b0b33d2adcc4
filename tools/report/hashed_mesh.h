#pragma once
/// A mesh with the hash of its files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "morsel/core/io/mesh_io.h"

namespace morsel::tools {

/// Where a mesh is read from.
struct MeshOrigin {
  std::filesystem::path path;                   ///< of the file; of bytes, what errors call them
  std::optional<core::MeshFormat> format = {};  ///< that of the extension if none is given
  std::optional<std::string_view> bytes = {};   ///< in place of a file, such as standard input; of `format`
};

/// core::read_polygon_soup() of it. Throws InvalidArgument for bytes without a format.
core::LoadedSoup read_polygon_soup(const MeshOrigin& file, const core::Progress& progress = {});
/// sha256_of_file() of it. Where core::companion_files() exist, the hash of a text: a line for the file and
/// for each of these, in their order, with the hash of its bytes; the last line is that of the file of
/// `options.mask`, if there is one.
std::string sha256_of(const MeshOrigin& file, const core::BuildOptions& options = {});

struct HashedMesh {
  core::LoadedMesh loaded;
  std::string sha256;
};

/// core::read_mesh() and, meanwhile, sha256_of().
HashedMesh read_hashed_mesh(const std::filesystem::path& path, const core::BuildOptions& options = {},
                            const core::Progress& progress = {});

HashedMesh read_hashed_mesh(const MeshOrigin& file, const core::BuildOptions& options = {},
                            const core::Progress& progress = {});

struct HashedWholeMesh {
  core::WholeMesh input;
  std::string sha256;
};

/// core::read_whole_mesh() and, meanwhile, sha256_of().
HashedWholeMesh read_hashed_whole_mesh(const std::filesystem::path& path,
                                       const core::BuildOptions& options = {},
                                       const core::Progress& progress = {});
HashedWholeMesh read_hashed_whole_mesh(const MeshOrigin& file, const core::BuildOptions& options = {},
                                       const core::Progress& progress = {});

}  // namespace morsel::tools
