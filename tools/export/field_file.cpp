#include "morsel/tools/export/field_file.h"

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/export/input_numbers.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  return core::checked_extension(path, "a field is written", {".txt", ".ply", ".vtp"});
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

}  // namespace

void check_field_path(const std::filesystem::path& path) { extension_of(path); }

void write_field(const std::filesystem::path& path, const core::ScalarField& field,
                 const core::VertexNumbering& numbering, std::span<const core::Point> input_positions,
                 const std::string& name, const Provenance& provenance) {
  const std::string extension = extension_of(path);
  const std::vector<double> values = by_input_vertex(field, numbering);
  if (extension == ".txt") {
    write_text(path, values, provenance);
    return;
  }
  const std::vector<core::Triangle> triangles = on_input_vertices(field.mesh(), numbering);
  if (extension == ".vtp") {
    VtpDocument document;
    document.points = {input_positions};
    document.polygons = {triangles, input_positions.size()};
    document.point_arrays = {{name, std::span<const double>(values)}};
    document.provenance = provenance.json();
    write_vtp(path, document);
  } else {
    const core::PropertyView property(name, values);
    core::write_ply(path, input_positions, triangles, {&property, 1}, {}, provenance.lines());
  }
}

}  // namespace morsel::tools
