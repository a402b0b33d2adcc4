#include "target.h"

#include <vector>

namespace morsel::fuzz {

std::span<const Target> targets() {
  static const std::vector<Target> kTargets = {{"off", "meshes", ".off", off},
                                               {"obj", "meshes", ".obj", obj},
                                               {"ply", "meshes", ".ply", ply},
                                               {"stl", "meshes", ".stl", stl},
                                               {"vtk", "meshes", ".vtk", vtk},
                                               {"vtp", "meshes", ".vtp", vtp},
                                               {"freesurfer", "meshes", ".pial", freesurfer},
                                               {"gifti", "meshes", ".gii", gifti},
                                               {"compressed", "compressed", "", compressed},
                                               {"gltf", "meshes", ".gltf", gltf},
                                               {"asc", "meshes", ".asc", asc},
                                               {"pdb", "pdb", "", pdb},
                                               {"mmcif", "mmcif", "", mmcif},
                                               {"pqr", "pqr", "", pqr},
                                               {"selection", "selection", "", selection},
                                               {"values", "values", "", values},
                                               {"specification", "specification", "", specification},
                                               {"chain", "chain", "", chain},
                                               {"report", "report", "", report},
                                               {"state", "state", "", state},
                                               {"journal", "journal", "", journal},
                                               {"provenance", "provenance", "", provenance},
                                               {"marks", "marks", "", marks},
                                               {"landmarks", "landmarks", "", landmarks}};
  return kTargets;
}

}  // namespace morsel::fuzz
