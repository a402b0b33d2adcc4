#pragma once
/// A Morse function on a mesh, before any method.

#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/tools/study/registry.h"

namespace morsel::tools {

/// The field before any method.
struct FieldOutcome {
  std::string name;
  core::ScalarField field;
  core::Parameters parameters;
  double seconds = 0;
  std::vector<core::FileParameter> files = {};  ///< that the function read
  std::string unit = {};                        ///< the function's, FunctionEntry::unit
  std::vector<std::string> warnings = {};       ///< the function's, and of critical points that mean nothing
};

/// Evaluates a Morse function on a loaded mesh.
FieldOutcome evaluate_field(const core::LoadedMesh& loaded, const NamedFunction& function,
                            const core::Progress& progress = {});

}  // namespace morsel::tools
