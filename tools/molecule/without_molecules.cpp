// In place of the grids of OpenVDB, in a program without molecules.

#include "morsel/core/io/molecule.h"
#include "morsel/tools/molecule/grid_mesh.h"

namespace morsel::tools {

QuadMesh mesh_solid(const Solid&, std::span<const Ball>, const Grid&, const core::Progress&) {
  core::require_molecules("the surface of a molecule");
  return {};
}

double grid_size(const Solid&, std::span<const Ball>, double) {
  core::require_molecules("the surface of a molecule");
  return 0;
}

}  // namespace morsel::tools
