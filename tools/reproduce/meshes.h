#pragma once
/// The meshes that stand in for the models of the paper.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/tools/reproduce/recipe.h"

namespace morsel::tools::reproduce {

struct MeshFile {
  std::filesystem::path path;  ///< of a surface that is made: in the folder of results
  bool is_sample = false;
  bool is_made = false;
};

/// For each of models() the mesh of it in `data` (none is looked for if that is empty), and the sample mesh
/// in `samples` where there is none. A mesh is a model's if its name is the model's ("lion.off"), or else if
/// it has the model's name or one of its words in it, in any case, and it has a mesh's extension. Throws
/// BadInput if `data` is no folder, holds none of the models or several meshes that could be one, and if
/// neither folder has a model: one sentence that lists all the names that were looked for.
std::vector<MeshFile> find_meshes(const std::filesystem::path& data, const std::filesystem::path& samples);

}  // namespace morsel::tools::reproduce
