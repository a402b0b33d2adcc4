#include "mesh_checks.h"
#include "target.h"

void morsel::fuzz::gltf(std::string_view bytes) { check_mesh_format(bytes, core::MeshFormat::gltf); }
