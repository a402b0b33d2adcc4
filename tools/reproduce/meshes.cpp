#include "morsel/tools/reproduce/meshes.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/listed.h"

namespace morsel::tools::reproduce {
namespace {

namespace fs = std::filesystem;

std::vector<std::string_view> words_of(const ModelRecipe& model) {
  std::vector<std::string_view> words = {model.name};
  words.insert(words.end(), model.words.begin(), model.words.end());
  return words;
}

/// The meshes of a folder, by name, so that the order of the file system makes no difference.
std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::vector<fs::path> meshes;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error))
    if (core::has_mesh_extension(entries->path())) meshes.push_back(entries->path());
  if (error) throw core::BadInput("cannot read the folder " + folder.string() + ": " + error.message());
  std::ranges::sort(meshes);
  return meshes;
}

std::optional<fs::path> find_model(const ModelRecipe& model, const std::vector<fs::path>& meshes) {
  std::vector<fs::path> exact, similar;
  for (const fs::path& mesh : meshes) {
    const std::string stem = core::lowered(mesh.stem().string());
    if (stem == model.name) exact.push_back(mesh);
    const auto has = [&](std::string_view word) { return stem.find(word) != std::string::npos; };
    if (std::ranges::any_of(words_of(model), has)) similar.push_back(mesh);
  }
  const std::vector<fs::path>& found = exact.empty() ? similar : exact;
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const fs::path& mesh : found) names.push_back(mesh.filename().string());
  throw core::BadInput(std::to_string(found.size()) + " meshes in " + found.front().parent_path().string() +
                       " could be the " + std::string(model.name) + ": " + core::listed(names, " and ") +
                       "; name the right one " + std::string(model.name) + " (" + core::mesh_extensions() +
                       ")");
}

/// What find_model() looks for.
std::string sought(const ModelRecipe& model) {
  std::vector<std::string> words;
  for (const std::string_view word : words_of(model)) words.push_back("\"" + std::string(word) + "\"");
  return core::listed(words, " or ");
}

}  // namespace

std::vector<MeshFile> find_meshes(const fs::path& data, const fs::path& samples) {
  std::error_code error;
  std::vector<fs::path> meshes;
  if (!data.empty()) {
    if (!fs::is_directory(data, error)) throw core::BadInput("there is no folder " + data.string());
    meshes = meshes_in(data);
  }
  std::vector<MeshFile> files;
  std::vector<std::string> missing, given;
  std::size_t found = 0;
  for (const ModelRecipe& model : models()) {
    if (model.make != nullptr) {
      files.push_back({std::string(model.name) + ".off", false, true});
      continue;
    }
    given.push_back(sought(model));
    if (const std::optional<fs::path> mesh = find_model(model, meshes)) {
      ++found;
      files.push_back({*mesh, false, false});
      continue;
    }
    const fs::path sample = samples / model.sample;
    files.push_back({sample, true, false});
    if (fs::is_regular_file(sample, error)) continue;
    missing.push_back(
        "the " + std::string(model.name) + " (" +
        (data.empty() ? "" : "a mesh with " + sought(model) + " in its name in " + data.string() + ", or ") +
        std::string(model.sample) + " in " + samples.string() + ")");
  }
  if (!data.empty() && found == 0)
    throw core::BadInput("no mesh in " + data.string() + " has " + core::listed(given, " or ") +
                         " in its name (" + core::mesh_extensions() + ")");
  if (!missing.empty())
    throw core::BadInput(
        "there is no mesh for " + core::listed(missing, " and ") +
        "; --meshes tells where the sample meshes are, which are those of CGAL's example data "
        "(Debian's package libcgal-demo)");
  return files;
}

}  // namespace morsel::tools::reproduce
