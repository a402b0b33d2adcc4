#include "morsel/tools/export/surface_file.h"

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/export/finite_persistence.h"

namespace morsel::tools {

std::string original_name(const std::string& field_name) { return field_name + "_original"; }
std::string change_name(const std::string& field_name) { return field_name + "_change"; }

std::vector<double> change_of(std::span<const double> field, std::span<const double> original) {
  std::vector<double> change(field.size());
  core::parallel_for_each(change.size(), [&](std::size_t i) { change[i] = field[i] - original[i]; });
  return change;
}

void write_surface_file(const core::FileTarget& target, const SurfaceFile& surface,
                        const Provenance& provenance, const std::vector<VtpArray>& more) {
  const core::TriangleMesh& mesh = surface.loaded.mesh;
  const std::size_t vertices = mesh.vertex_count();
  const core::VertexNumbering& numbering = surface.loaded.source.numbering;
  const std::vector<double> change = change_of(surface.field.values(), surface.original.values());
  const FinitePersistence persistence = finite_persistence(surface.persistence, surface.field.extent());
  VtpDocument document;
  document.points = {mesh.positions()};
  document.polygons = {mesh.triangles(), vertices};
  document.point_arrays = {{surface.field_name, surface.field.values()},
                           {original_name(surface.field_name), surface.original.values()},
                           {change_name(surface.field_name), std::span<const double>(change)},
                           {"critical_type", surface.critical_types},
                           {"persistence", std::span<const double>(persistence.values)},
                           {"essential", std::span<const std::uint8_t>(persistence.essential)},
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
