#include "morsel/tools/export/surface_file.h"

namespace morsel::tools {

void write_surface_file(const core::FileTarget& target, const SurfaceFile& surface,
                        const Provenance& provenance, const std::vector<VtpArray>& more) {
  const core::TriangleMesh& mesh = surface.loaded.mesh;
  const std::size_t vertices = mesh.vertex_count();
  const core::VertexNumbering& numbering = surface.loaded.source.numbering;
  VtpDocument document;
  document.points = {mesh.positions()};
  document.polygons = {mesh.triangles(), vertices};
  document.point_arrays = {{surface.field_name, surface.field.values()},
                           {"critical_type", surface.critical_types},
                           {"persistence", surface.persistence},
                           {"input_vertex", vertices, numbering.input_count, [&](std::size_t v) {
                              return std::int64_t{numbering.input_vertex(static_cast<core::Index>(v))};
                            }}};
  if (!surface.chosen.empty()) document.point_arrays.emplace_back("chosen", surface.chosen);
  const auto add = [&](const char* name, const mscomplex::SegmentLabels& segments) {
    document.point_arrays.emplace_back(name, segments.vertex, segments.count);
    document.cell_arrays.emplace_back(name, segments.triangle, segments.count);
  };
  add("descending", surface.segmentation.descending);
  add("ascending", surface.segmentation.ascending);
  add("morse_smale", surface.segmentation.morse_smale);
  document.cell_arrays.insert(document.cell_arrays.end(), more.begin(), more.end());
  document.provenance = provenance.json();
  write_vtp(target, document, core::Sync::never);
}

}  // namespace morsel::tools
