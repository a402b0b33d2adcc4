#include "morsel/tools/report/mesh_section.h"

namespace morsel::tools {

Json repairs_section(const std::vector<core::Repair>& repairs) {
  Json list = Json::array();
  for (const core::Repair& repair : repairs)
    list.push_back({{"action", repair.action}, {"count", repair.count}});
  return list;
}

Json mesh_section(const std::filesystem::path& path, const std::string& sha256,
                  const core::LoadedMesh& loaded) {
  const core::TriangleMesh& mesh = loaded.mesh;
  Json section = {{"path", path.string()},
                  {"sha256", sha256},
                  {"vertices", mesh.vertex_count()},
                  {"edges", mesh.edge_count()},
                  {"faces", mesh.triangle_count()},
                  {"components", mesh.component_count()},
                  {"boundary_loops", mesh.boundary_loop_count()},
                  {"euler_characteristic", mesh.euler_characteristic()},
                  {"genus", mesh.genus()},
                  {"bbox_diagonal", mesh.bounding_box().diagonal()},
                  {"repairs", repairs_section(loaded.source.repairs)}};
  if (!loaded.source.warnings.empty()) section["warnings"] = loaded.source.warnings;
  return section;
}

}  // namespace morsel::tools
