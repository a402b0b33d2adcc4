#include "morsel/tools/export/label_file.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/export/brain_files.h"
#include "morsel/tools/export/input_numbers.h"
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

std::string label_extension(const fs::path& path) {
  return core::checked_extension(path, "labels are written",
                                 {".ply", ".vtp", ".txt", ".annot", ".label.gii"});
}

/// The colours of pictures' segments, by turns: Paul Tol's "light" qualitative scheme (BSD).
std::vector<std::array<std::uint8_t, 3>> colors_of(std::size_t labels) {
  constexpr std::array<std::uint32_t, 9> kLight = {0x77aadd, 0xee8866, 0xeedd88, 0xffaabb, 0x99ddff,
                                                   0x44bb99, 0xbbcc33, 0xaaaa00, 0xdddddd};
  std::vector<std::array<std::uint8_t, 3>> colors(labels);
  for (std::size_t i = 0; i < labels; ++i) {
    const std::uint32_t color = kLight[i % kLight.size()];
    colors[i] = {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
                 static_cast<std::uint8_t>(color)};
  }
  return colors;
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

std::vector<fs::path> label_files(const fs::path& path) {
  if (label_extension(path) != ".txt") return {path};
  fs::path base = path;
  base.replace_extension();
  return {base.string() + ".vertices" + path.extension().string(),
          base.string() + ".faces" + path.extension().string()};
}

std::vector<fs::path> write_labels(const fs::path& path, const Labels& labels, const core::ScalarField& field,
                                   const std::string& field_name, const core::VertexNumbering& numbering,
                                   std::span<const core::Point> input_positions,
                                   const Provenance& provenance) {
  std::vector<fs::path> files = label_files(path);
  const std::vector<std::int32_t> at_vertices = by_input_vertex(labels.vertex, numbering);
  if (const std::string extension = label_extension(path);
      extension == ".annot" || extension == ".label.gii") {
    const std::size_t count =
        labels.triangle.empty() ? 0 : std::size_t{*std::ranges::max_element(labels.triangle)} + 1;
    const std::vector<std::array<std::uint8_t, 3>> colors = colors_of(count);
    const BrainLabels brain{labels.name, at_vertices, colors};
    if (extension == ".annot")
      write_annotation(path, brain, provenance);
    else
      write_gifti_labels(path, brain, provenance);
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
  if (core::file_extension(path) == ".ply") {
    const core::PropertyView of_vertices(labels.name, at_vertices);
    const core::PropertyView of_faces(labels.name, at_triangles);
    core::write_ply(path, input_positions, triangles, {&of_vertices, 1}, {&of_faces, 1}, provenance.lines());
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
  write_vtp(path, document);
  return files;
}

}  // namespace morsel::tools
