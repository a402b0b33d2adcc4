#include "morsel/tools/export/field_file.h"

#include <algorithm>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"
#include "morsel/core/mesh_writer.h"
#include "morsel/tools/export/vtp_writer.h"

namespace morsel::tools {
namespace {

enum class Format { text, ply, vtp };

Format format_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".txt") return Format::text;
  if (extension == ".ply") return Format::ply;
  if (extension == ".vtp") return Format::vtp;
  throw core::InvalidArgument("a field is written as .txt, .ply or .vtp, not as " + path.string());
}

std::vector<double> input_values(const core::ScalarField& field, const core::VertexNumbering& numbering) {
  std::vector<double> values(numbering.input_count, std::numeric_limits<double>::quiet_NaN());
  for (core::Index i = 0; i < values.size(); ++i) {
    const core::Index v = numbering.mesh_vertex(i);
    if (v != core::kNone) values[i] = field.value(v);
  }
  return values;
}

void write_text(const std::filesystem::path& path, std::span<const double> values) {
  core::FileWriter file(path);
  for (const double value : values) {
    file.write_number(value);
    file.write("\n");
  }
  file.commit();
}

}  // namespace

void check_field_path(const std::filesystem::path& path) { format_of(path); }

void write_field(const std::filesystem::path& path, const core::ScalarField& field,
                 const core::VertexNumbering& numbering, std::span<const core::Point> input_positions,
                 const std::string& name) {
  const Format format = format_of(path);
  const std::vector<double> values = input_values(field, numbering);
  if (format == Format::text) {
    write_text(path, values);
    return;
  }
  std::vector<core::Triangle> triangles(field.mesh().triangles().begin(), field.mesh().triangles().end());
  for (core::Triangle& t : triangles)
    for (core::Index& v : t) v = numbering.input_vertex(v);
  if (format == Format::vtp) {
    VtpDocument document;
    document.points = {input_positions};
    document.polygons = {triangles, input_positions.size()};
    document.point_arrays = {{name, std::span<const double>(values)}};
    write_vtp(path, document);
  } else {
    const core::PropertyView property(name, values);
    core::write_ply(path, input_positions, triangles, {&property, 1});
  }
}

}  // namespace morsel::tools
