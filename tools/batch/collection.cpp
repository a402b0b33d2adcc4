#include "morsel/tools/batch/collection.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/mesh_io.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

/// A path whose status is unknown is read as a list, which reports the error.
bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<CollectionMesh> of_folder(const fs::path& folder) {
  std::vector<CollectionMesh> meshes;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::error_code unreadable;
        core::has_mesh_extension(at->path()) && fs::is_regular_file(at->path(), unreadable))
      meshes.push_back({mesh_name(at->path().lexically_relative(folder)), at->path()});
  if (error) throw core::BadInput("cannot read the folder " + folder.string() + ": " + error.message());
  if (meshes.empty())
    throw core::BadInput("there is no mesh (" + core::mesh_extensions(", ") + ") in the folder " +
                         folder.string());
  std::sort(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return meshes;
}

using Names = std::set<std::string, std::less<>>;

/// The meshes of those lines that end in one of these file names; of all, if there are none.
std::vector<CollectionMesh> of_list(const fs::path& list, const Names& files) {
  if (core::has_mesh_extension(list))
    throw core::BadInput(list.string() + " is a mesh, not a list of meshes or a folder");
  const core::FileBytes bytes(list, list.string());
  std::vector<CollectionMesh> meshes;
  std::string_view rest = bytes.view();
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    if (!files.empty() && !files.contains(line.substr(line.rfind('/') + 1))) continue;
    const fs::path path(line);
    std::string name = mesh_name(path);
    if (name.empty())
      throw core::BadInput(list.string() + ", line " + std::to_string(number) + ": that names no file");
    meshes.push_back({std::move(name), list.parent_path() / path});
  }
  return meshes;
}

/// The mesh of this name in a folder, if of_folder() would find it, which skips folders that are links.
std::optional<CollectionMesh> in_folder(const fs::path& folder, const std::string& name) {
  if (name.empty() || mesh_name(name) != name || !core::has_mesh_extension(name)) return std::nullopt;
  fs::path path = folder;
  for (const fs::path& part : fs::path(name).parent_path()) {
    path /= part;
    if (std::error_code error; fs::is_symlink(path, error) || error) return std::nullopt;
  }
  path = folder / name;
  std::error_code error;
  return fs::is_regular_file(path, error) ? std::optional(CollectionMesh{name, path}) : std::nullopt;
}

/// Those with these names, as far as they are found without reading the whole collection.
std::vector<CollectionMesh> found_directly(const fs::path& folder_or_list, const Names& names) {
  std::vector<CollectionMesh> meshes;
  if (is_folder(folder_or_list)) {
    for (const std::string& name : names)
      if (std::optional<CollectionMesh> mesh = in_folder(folder_or_list, name))
        meshes.push_back(std::move(*mesh));
  } else {
    Names files;
    for (const std::string& name : names) files.insert(name.substr(name.rfind('/') + 1));
    meshes = of_list(folder_or_list, files);
    std::erase_if(meshes, [&](const CollectionMesh& mesh) { return !names.contains(mesh.name); });
  }
  return meshes;
}

/// Throws where results of two meshes would have the same place.
void check_names(const fs::path& folder_or_list, const std::vector<CollectionMesh>& meshes) {
  // Where / comes before all other characters, a name is followed by those in a folder of that name.
  const auto less = [](std::string_view a, std::string_view b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
      return x != y && y != '/' &&
             (x == '/' || static_cast<unsigned char>(x) < static_cast<unsigned char>(y));
    });
  };
  std::set<std::string_view, decltype(less)> names(less);
  for (const CollectionMesh& mesh : meshes)
    if (!names.insert(mesh.name).second)
      throw core::BadInput(folder_or_list.string() + " has two meshes that would be called " + mesh.name);
  std::string_view before;
  for (const std::string_view name : names) {
    if (!before.empty() && name.starts_with(before) && name[before.size()] == '/')
      throw core::BadInput(folder_or_list.string() + " has a mesh that would be called " +
                           std::string(before) + " and one in a folder of that name, " + std::string(name));
    before = name;
  }
}

}  // namespace

std::string mesh_name(const fs::path& path) {
  fs::path name;
  for (const fs::path& part : path.relative_path().lexically_normal())
    if (part != ".." && part != ".") name /= part;
  return name.has_filename() ? name.string() : "";
}

std::vector<CollectionMesh> read_collection(const fs::path& folder_or_list,
                                            const std::vector<std::string>& wanted) {
  const Names names(wanted.begin(), wanted.end());
  if (!names.empty()) {
    std::vector<CollectionMesh> meshes = found_directly(folder_or_list, names);
    check_names(folder_or_list, meshes);
    if (meshes.size() == names.size()) return meshes;
  }
  std::vector<CollectionMesh> meshes =
      is_folder(folder_or_list) ? of_folder(folder_or_list) : of_list(folder_or_list, {});
  if (meshes.empty()) throw core::BadInput("there is no mesh in the list " + folder_or_list.string());
  check_names(folder_or_list, meshes);
  if (names.empty()) return meshes;
  Names missing = names;
  for (const CollectionMesh& mesh : meshes) missing.erase(mesh.name);
  if (!missing.empty())
    throw core::InvalidArgument("the collection has no mesh called " + *missing.begin() +
                                "; names are paths within it, such as " + meshes.front().name);
  std::erase_if(meshes, [&](const CollectionMesh& mesh) { return !names.contains(mesh.name); });
  return meshes;
}

}  // namespace morsel::tools::batch
