#include "morsel/tools/batch/collection.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/file_bytes.h"
#include "morsel/core/file_extension.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

bool is_mesh(const fs::path& path) {
  constexpr std::array<std::string_view, 4> kExtensions = {".off", ".obj", ".ply", ".stl"};
  return std::find(kExtensions.begin(), kExtensions.end(), core::file_extension(path)) != kExtensions.end();
}

std::vector<CollectionMesh> of_folder(const fs::path& folder) {
  std::vector<CollectionMesh> meshes;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file() && is_mesh(at->path()))
      meshes.push_back({mesh_name(at->path().lexically_relative(folder)), at->path()});
  if (error) throw core::BadInput("cannot read the folder " + folder.string() + ": " + error.message());
  if (meshes.empty())
    throw core::BadInput("there is no mesh (.off, .obj, .ply, .stl) in the folder " + folder.string());
  std::sort(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return meshes;
}

std::vector<CollectionMesh> of_list(const fs::path& list) {
  if (is_mesh(list)) throw core::BadInput(list.string() + " is a mesh, not a list of meshes or a folder");
  const core::FileBytes bytes(list, list.string());
  std::vector<CollectionMesh> meshes;
  std::string_view rest = bytes.view();
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    const fs::path path(line);
    std::string name = mesh_name(path);
    if (name.empty())
      throw core::BadInput(list.string() + ", line " + std::to_string(number) + ": that names no file");
    meshes.push_back({std::move(name), list.parent_path() / path});
  }
  if (meshes.empty()) throw core::BadInput("there is no mesh in the list " + list.string());
  return meshes;
}

}  // namespace

std::string mesh_name(const fs::path& path) {
  fs::path name;
  for (const fs::path& part : path.relative_path().lexically_normal())
    if (part != ".." && part != ".") name /= part;
  return name.has_filename() ? name.string() : "";
}

std::vector<CollectionMesh> read_collection(const fs::path& folder_or_list) {
  std::vector<CollectionMesh> meshes =
      fs::is_directory(folder_or_list) ? of_folder(folder_or_list) : of_list(folder_or_list);
  std::set<std::string_view> names;
  for (const CollectionMesh& mesh : meshes)
    if (!names.insert(mesh.name).second)
      throw core::BadInput(folder_or_list.string() + " has two meshes that would be called " + mesh.name);
  return meshes;
}

std::vector<CollectionMesh> chosen(const std::vector<CollectionMesh>& meshes,
                                   const std::vector<std::string>& names) {
  if (names.empty()) return meshes;
  std::set<std::string_view> missing(names.begin(), names.end());
  std::vector<CollectionMesh> found;
  for (const CollectionMesh& mesh : meshes) {
    if (std::find(names.begin(), names.end(), mesh.name) == names.end()) continue;
    missing.erase(mesh.name);
    found.push_back(mesh);
  }
  if (!missing.empty())
    throw core::InvalidArgument("the collection has no mesh called " + std::string(*missing.begin()) +
                                "; names are paths within it, such as " + meshes.front().name);
  return found;
}

}  // namespace morsel::tools::batch
