#pragma once
/// A Morse function on a mesh, before any method.

#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/tools/study/registry.h"

namespace morsel::tools {

/// A file that a Morse function read, besides the mesh's.
struct FieldFile {
  std::string key;  ///< of the function, which names it
  std::string path;
};

/// The field before any method.
struct FieldOutcome {
  std::string name;
  core::ScalarField field;
  core::Parameters parameters;
  double seconds = 0;
  std::vector<FieldFile> files = {};
  std::vector<std::string> warnings = {};  ///< the function's, and of critical points that mean nothing
};

/// Evaluates a Morse function on a loaded mesh.
FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress = {});

}  // namespace morsel::tools
