#include "morsel/tools/export/label_file.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/color/regions.h"
#include "morsel/tools/color/surface_colors.h"
#include "morsel/tools/export/brain_files.h"
#include "morsel/tools/export/glb_scene.h"
#include "morsel/tools/export/input_numbers.h"
#include "morsel/tools/export/ply_colors.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

namespace fs = std::filesystem;

std::vector<std::int32_t> by_input_vertex(std::span<const core::Index> label,
                                          const core::VertexNumbering& numbering) {
  std::vector<std::int32_t> result(numbering.input_count);
  core::parallel_for_each(result.size(), [&](std::size_t i) {
    const core::Index v = numbering.mesh_vertex(static_cast<core::Index>(i));
    result[i] = v == core::kNone ? -1 : static_cast<std::int32_t>(label[v]);
  });
  return result;
}

std::string label_extension(const core::FileTarget& target) {
  if (target.is_open_file())
    return core::checked_extension(target, "labels are written",
                                   {".ply", ".vtp", ".annot", ".label.gii", ".glb"});
  return core::checked_extension(target, "labels are written",
                                 {".ply", ".vtp", ".txt", ".annot", ".label.gii", ".glb"});
}

void write_lines(core::FileWriter& file, std::span<const std::int32_t> labels, const Provenance& provenance) {
  file.write(provenance.text_comment());
  for (const std::int32_t label : labels) {
    if (label < 0)
      file.write("-1");
    else
      file.write_number(static_cast<std::uint64_t>(label));
    file.write("\n");
  }
}

}  // namespace

std::vector<core::FileTarget> label_files(const core::FileTarget& target) {
  if (label_extension(target) != ".txt") return {target};
  fs::path base = target.path;
  const std::string extension = base.extension().string();
  base.replace_extension();
  return {base.string() + ".vertices" + extension, base.string() + ".faces" + extension};
}

std::vector<core::FileTarget> write_labels(const core::FileTarget& target, const Labels& labels,
                                           const core::ScalarField& field, const std::string& field_name,
                                           const core::VertexNumbering& numbering,
                                           std::span<const core::Point> input_positions,
                                           const Provenance& provenance) {
  std::vector<core::FileTarget> files = label_files(target);
  const std::string extension = label_extension(target);
  if (extension == ".glb") {
    GlbScene scene(field.mesh());
    scene.add_segments(labels.triangle, color_labels(field.mesh(), labels.vertex, labels.triangle));
    scene.write(target, provenance);
    return files;
  }
  const std::vector<std::int32_t> at_vertices = by_input_vertex(labels.vertex, numbering);
  if (extension == ".annot" || extension == ".label.gii") {
    const std::vector<ColorBytes> colors =
        to_bytes(color_labels(field.mesh(), labels.vertex, labels.triangle));
    const BrainLabels brain{labels.name, at_vertices, colors};
    if (extension == ".annot")
      write_annotation(target, brain, provenance);
    else
      write_gifti_labels(target, brain, provenance);
    return files;
  }
  const std::vector<std::int32_t> at_triangles(labels.triangle.begin(), labels.triangle.end());
  if (files.size() == 2) {
    core::FileWriter vertices(files[0]);
    core::FileWriter faces(files[1]);
    write_lines(vertices, at_vertices, provenance);
    write_lines(faces, at_triangles, provenance);
    vertices.commit();
    faces.commit();
    return files;
  }
  const std::vector<core::Triangle> triangles = on_input_vertices(field.mesh(), numbering);
  if (extension == ".ply") {
    const std::vector<Color> palette = color_labels(field.mesh(), labels.vertex, labels.triangle);
    const PlyColors vertex_colors(to_bytes(label_colors(at_vertices, palette)));
    const PlyColors face_colors(to_bytes(label_colors(at_triangles, palette)));
    std::vector<core::PropertyView> of_vertices = {{labels.name, std::span<const std::int32_t>(at_vertices)}};
    std::vector<core::PropertyView> of_faces = {{labels.name, std::span<const std::int32_t>(at_triangles)}};
    vertex_colors.add_to(of_vertices);
    face_colors.add_to(of_faces);
    core::write_ply(target, input_positions, triangles, of_vertices, of_faces, provenance.lines());
    return files;
  }
  const std::vector<double> values = by_input_vertex(field, numbering);
  VtpDocument document;
  document.points = {input_positions};
  document.polygons = {triangles, input_positions.size()};
  document.point_arrays = {{labels.name, std::span<const std::int32_t>(at_vertices)},
                           {field_name, std::span<const double>(values)}};
  document.cell_arrays = {{labels.name, std::span<const std::int32_t>(at_triangles)}};
  document.provenance = provenance.json();
  write_vtp(target, document);
  return files;
}

}  // namespace morsel::tools
