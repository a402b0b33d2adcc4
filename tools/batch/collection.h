#pragma once
/// The meshes of a collection: those of a folder or of a list, with the names of their results.

#include <filesystem>
#include <string>
#include <vector>

namespace morsel::tools::batch {

struct CollectionMesh {
  std::string name;            ///< the path within the collection, extension included: "scans/lion.off"
  std::filesystem::path path;  ///< to be opened from the working folder

  friend bool operator==(const CollectionMesh&, const CollectionMesh&) = default;
};

/// Of a folder: all files with a mesh's extension in it and the folders in it, by name. Of any other file: a
/// mesh on each line, in the order of the lines; relative paths begin at the list's folder; empty lines and
/// those that begin with # are skipped.
///
/// The name of what a list has outside its folder is its path without a leading "/" and without "..". Throws
/// BadInput where the folder or list cannot be read or has no mesh, where two meshes have one name, and where
/// one's name is a folder of another's.
///
/// With names, only the meshes of these names, in the same order, without reading the whole collection where
/// possible; throws InvalidArgument on a name that is not there.
std::vector<CollectionMesh> read_collection(const std::filesystem::path& folder_or_list,
                                            const std::vector<std::string>& names = {});

/// The name of a mesh of this path within a collection. Empty for a path that names no file.
std::string mesh_name(const std::filesystem::path& path);

}  // namespace morsel::tools::batch
