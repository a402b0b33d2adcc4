#include "morsel/tools/export/field_file.h"

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/export/brain_files.h"
#include "morsel/tools/export/input_numbers.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

constexpr const char* kChosen = "chosen";

/// Standard output, which has no extension, takes text.
std::string extension_of(const std::filesystem::path& path) {
  if (path == kStandardOutput) return ".txt";
  return core::checked_extension(path, "a field is written",
                                 {".txt", ".ply", ".vtp", ".shape.gii", ".func.gii"});
}

void write_text(const std::filesystem::path& path, std::span<const double> values,
                const Provenance& provenance) {
  core::FileWriter file(path);
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

void check_field_path(const std::filesystem::path& path) { extension_of(path); }

bool holds_points(const std::filesystem::path& field_path) {
  const std::string extension = extension_of(field_path);
  return extension == ".ply" || extension == ".vtp";
}

void write_field(const std::filesystem::path& path, const core::ScalarField& field,
                 const core::VertexNumbering& numbering, std::span<const core::Point> input_positions,
                 const std::string& name, const Provenance& provenance, const MadePoints* chosen) {
  const std::string extension = extension_of(path);
  const std::vector<double> values = by_input_vertex(field, numbering);
  if (extension == ".txt") {
    write_text(path, values, provenance);
    return;
  }
  if (extension.ends_with(".gii")) {
    write_gifti_values(path, values, extension == ".shape.gii" ? "NIFTI_INTENT_SHAPE" : "NIFTI_INTENT_NONE",
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
    if (chosen != nullptr) document.point_arrays.emplace_back(kChosen, std::span<const std::int32_t>(order));
    document.provenance = provenance.json();
    write_vtp(path, document);
  } else {
    std::vector<core::PropertyView> properties = {{name, std::span<const double>(values)}};
    if (chosen != nullptr) properties.emplace_back(kChosen, std::span<const std::int32_t>(order));
    core::write_ply(path, input_positions, triangles, properties, {}, provenance.lines());
  }
}

}  // namespace morsel::tools
