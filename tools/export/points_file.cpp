#include "morsel/tools/export/points_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/export/glb_scene.h"
#include "morsel/tools/export/ply_colors.h"
#include "morsel/tools/formats/csv.h"
#include "morsel/tools/formats/vtp_writer.h"

namespace morsel::tools {
namespace {

/// 1, 2, 3: as the surface files of compare --export have them.
std::int32_t code_of(morse::CriticalType type) { return static_cast<std::int32_t>(type); }

/// The points by their numbers, each of them in a list of its own.
struct Columns {
  std::vector<core::Point> positions;
  std::vector<std::pair<const char*, std::vector<std::int32_t>>> whole = {
      {"vertex", {}}, {"type", {}}, {"multiplicity", {}}, {"field", {}}, {"essential", {}}};
  std::vector<std::pair<const char*, std::vector<double>>> real = {
      {"value", {}}, {"persistence", {}}, {"rank", {}}, {"distance", {}}, {"percentile", {}}};
};

Columns columns_of(const MadePoints& made, const core::LoadedMesh& loaded, const core::ScalarField& field) {
  Columns columns;
  for (std::size_t i = 0; i < made.chosen.points.size(); ++i) {
    const auto& [candidate, source, distance] = made.chosen.points[i];
    const morse::CriticalPoint& point = candidate.point;
    const double extent = source == 0 ? field.extent() : made.fill->field.extent();
    const bool is_finite = std::isfinite(candidate.persistence);
    columns.positions.push_back(loaded.mesh.position(made.places[i]));
    const std::array whole = {static_cast<std::int32_t>(loaded.source.numbering.input_vertex(point.vertex)),
                              code_of(point.type), static_cast<std::int32_t>(point.multiplicity),
                              static_cast<std::int32_t>(source), is_finite ? 0 : 1};
    const std::array real = {candidate.value, is_finite ? candidate.persistence : extent, candidate.rank,
                             distance, made.percentile(i).value_or(std::numeric_limits<double>::quiet_NaN())};
    for (std::size_t k = 0; k < whole.size(); ++k) columns.whole[k].second.push_back(whole[k]);
    for (std::size_t k = 0; k < real.size(); ++k) columns.real[k].second.push_back(real[k]);
  }
  return columns;
}

}  // namespace

std::vector<std::int32_t> chosen_order(const MadePoints& made, core::Index vertices) {
  std::vector<std::int32_t> order(vertices, 0);
  for (std::size_t i = 0; i < made.chosen.points.size(); ++i)
    order[made.chosen.points[i].candidate.point.vertex] = static_cast<std::int32_t>(i + 1);
  return order;
}

void check_points_path(const core::FileTarget& target) {
  core::checked_extension(target, "points are written", {".csv", ".json", ".ply", ".vtp", ".glb"});
}

void write_points_table(const core::FileTarget& target, const MadePoints& made,
                        const core::LoadedMesh& loaded, const std::string& field_name,
                        const Provenance& provenance, core::Sync sync) {
  core::FileWriter file(target, sync);
  CsvTable table(file.stream(), {"vertex", "x", "y", "z", "type", "type_code", "multiplicity", "value",
                                 "persistence", "rank", "distance", "percentile", "field"});
  for (std::size_t i = 0; i < made.chosen.points.size(); ++i) {
    const auto& [candidate, source, distance] = made.chosen.points[i];
    const morse::CriticalPoint& point = candidate.point;
    CsvLine line;
    line.add(std::uint64_t{loaded.source.numbering.input_vertex(point.vertex)});
    for (const double x : loaded.mesh.position(made.places[i])) line.add(x);
    line.add(to_string(point.type));
    line.add(static_cast<std::uint64_t>(code_of(point.type)));
    line.add(std::uint64_t{point.multiplicity});
    for (const double number : {candidate.value, candidate.persistence, candidate.rank, distance})
      line.add(number);
    line.add(made.percentile(i));
    line.add(source == 0 ? field_name : made.fill->name);
    table.add(line);
  }
  table.end(provenance.lines());
  file.commit();
}

void write_points(const core::FileTarget& target, const MadePoints& made, const FieldSource& source,
                  const Provenance& provenance) {
  const std::string extension =
      core::checked_extension(target, "points are written", {".csv", ".ply", ".vtp", ".glb"});
  if (extension == ".csv") {
    write_points_table(target, made, source.loaded, source.made.input.name, provenance);
    return;
  }
  if (extension == ".glb") {
    GlbScene scene(source.loaded.mesh);
    scene.add_surface(value_colors(source.made.field().values()));
    scene.add_marks(marks_of(made));
    scene.write(target, provenance);
    return;
  }
  const Columns columns = columns_of(made, source.loaded, source.made.field());
  if (extension == ".ply") {
    std::vector<core::PropertyView> properties;
    for (const auto& [name, values] : columns.whole)
      properties.emplace_back(name, std::span<const std::int32_t>(values));
    for (const auto& [name, values] : columns.real)
      properties.emplace_back(name, std::span<const double>(values));
    std::vector<Color> colors_of_types;
    for (const morse::ChosenPoint& point : made.chosen.points)
      colors_of_types.push_back(color_of(point.candidate.point.type));
    const PlyColors colors(to_bytes(colors_of_types));
    add_quality(properties, columns.real.front().second);
    colors.add_to(properties);
    core::write_ply(target, columns.positions, {}, properties, {}, provenance.lines());
    return;
  }
  VtpDocument document;
  document.points = {columns.positions};
  document.vertices = {columns.positions.size(), 0,
                       [](std::size_t i) { return static_cast<std::int64_t>(i + 1); }};
  for (const auto& [name, values] : columns.whole)
    document.point_arrays.emplace_back(name, std::span<const std::int32_t>(values));
  for (const auto& [name, values] : columns.real)
    document.point_arrays.emplace_back(name, std::span<const double>(values));
  document.provenance = provenance.json();
  write_vtp(target, document);
}

}  // namespace morsel::tools
