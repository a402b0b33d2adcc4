#include "morsel/tools/export/field_file.h"

#include <algorithm>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/morse/critical_points.h"
#include "morsel/tools/color/surface_colors.h"
#include "morsel/tools/export/brain_files.h"
#include "morsel/tools/export/glb_scene.h"
#include "morsel/tools/export/input_numbers.h"
#include "morsel/tools/export/ply_colors.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/export/surface_file.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

constexpr const char* kChosen = "chosen";

std::string extension_of(const core::FileTarget& target) {
  return core::checked_extension(target, "a field is written",
                                 {".txt", ".ply", ".vtp", ".glb", ".shape.gii", ".func.gii"});
}

void write_text(const core::FileTarget& target, std::span<const double> values,
                const Provenance& provenance) {
  core::FileWriter file(target);
  file.write(provenance.text_comment());
  for (const double value : values) {
    file.write_number(value);
    file.write("\n");
  }
  file.commit();
}

/// By the input's vertices.
std::vector<std::int32_t> chosen_order(const MadePoints& chosen, const core::TriangleMesh& mesh,
                                       const core::VertexNumbering& numbering) {
  const std::vector<std::int32_t> by_vertex = tools::chosen_order(chosen, mesh.vertex_count());
  std::vector<std::int32_t> order(numbering.input_count, 0);
  for (core::Index v = 0; v < by_vertex.size(); ++v)
    if (by_vertex[v] > 0) order[numbering.input_vertex(v)] = by_vertex[v];
  return order;
}

}  // namespace

void check_field_path(const core::FileTarget& target) { extension_of(target); }

bool holds_points(const core::FileTarget& field) {
  const std::string extension = extension_of(field);
  return extension == ".ply" || extension == ".vtp" || extension == ".glb";
}

void write_field(const core::FileTarget& target, const FieldSource& source,
                 std::span<const core::Point> input_positions, const Provenance& provenance,
                 const MadePoints* chosen) {
  const std::string extension = extension_of(target);
  const core::ScalarField& field = source.made.field();
  const core::VertexNumbering& numbering = source.loaded.source.numbering;
  const std::string& name = source.made.input.name;
  if (extension == ".glb") {
    GlbScene scene(field.mesh());
    scene.add_surface(value_colors(field.values()));
    scene.add_marks(chosen != nullptr ? marks_of(*chosen) : marks_of(morse::classify(field)));
    scene.write(target, provenance);
    return;
  }
  const std::vector<double> values = by_input_vertex(field, numbering);
  if (extension == ".txt") {
    write_text(target, values, provenance);
    return;
  }
  if (extension.ends_with(".gii")) {
    write_gifti_values(target, values, extension == ".shape.gii" ? "NIFTI_INTENT_SHAPE" : "NIFTI_INTENT_NONE",
                       name, provenance);
    return;
  }
  std::vector<std::int32_t> order;
  if (chosen != nullptr) order = chosen_order(*chosen, field.mesh(), numbering);
  const std::vector<core::Triangle> triangles = on_input_vertices(field.mesh(), numbering);
  if (extension == ".vtp") {
    VtpDocument document;
    document.points = {input_positions};
    document.polygons = {triangles, input_positions.size()};
    document.point_arrays = {{name, std::span<const double>(values)}};
    std::vector<double> original;
    std::vector<double> change;
    if (!std::ranges::equal(field.values(), source.made.input.field.values())) {
      original = by_input_vertex(source.made.input.field, numbering);
      change = change_of(values, original);
      document.point_arrays.emplace_back(original_name(name), std::span<const double>(original));
      document.point_arrays.emplace_back(change_name(name), std::span<const double>(change));
    }
    if (chosen != nullptr) document.point_arrays.emplace_back(kChosen, std::span<const std::int32_t>(order));
    document.provenance = provenance.json();
    write_vtp(target, document);
  } else {
    std::vector<core::PropertyView> properties = {{name, std::span<const double>(values)}};
    if (chosen != nullptr) properties.emplace_back(kChosen, std::span<const std::int32_t>(order));
    const PlyColors colors(to_bytes(value_colors(values)));
    add_quality(properties, values);
    colors.add_to(properties);
    core::write_ply(target, input_positions, triangles, properties, {}, provenance.lines());
  }
}

}  // namespace morsel::tools
