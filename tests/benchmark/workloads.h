#pragma once
/// The inputs: sample meshes made larger, with seeded noise.

#include <string>

#include "morsel/core/field/scalar_field.h"

namespace morsel::benchmark {

struct Workload {
  std::string mesh_name;
  core::TriangleMesh mesh;
};

/// A sample mesh with every edge cut into `pieces` and, if it was cut, uniform noise of 5 % of the mean edge
/// length.
Workload workload(const std::string& sample, int pieces);

/// "height" or "mean-curvature".
core::ScalarField field_of(const core::TriangleMesh& mesh, const std::string& name);

/// Scratch files in the three formats; returns the path. `extension` is off, obj or ply.
std::string write_mesh(const core::TriangleMesh& mesh, const std::string& folder,
                       const std::string& extension);

}  // namespace morsel::benchmark
