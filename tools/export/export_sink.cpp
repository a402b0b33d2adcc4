#include "morsel/tools/export/export_sink.h"

#include <cmath>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"
#include "morsel/core/parameters.h"
#include "morsel/tools/export/vtp_writer.h"

namespace morsel::tools {
namespace {

std::vector<std::int32_t> input_numbers(const core::LoadedMesh& loaded) {
  std::vector<std::int32_t> numbers(loaded.mesh.vertex_count());
  for (core::Index v = 0; v < numbers.size(); ++v)
    numbers[v] = static_cast<std::int32_t>(loaded.source.numbering.input_vertex(v));
  return numbers;
}

void write_surface(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                   const std::string& field_name, const MethodOutcome& outcome) {
  const Measurement& m = outcome.measurement;
  const std::vector<std::int32_t> numbers = input_numbers(loaded);
  std::vector<std::uint8_t> types(numbers.size(), 0);
  for (const morse::CriticalPoint& point : m.critical_points.points)
    types[point.vertex] = static_cast<std::uint8_t>(point.type);
  const std::vector<double> persistence =
      persistence::vertex_persistence(m.diagram, static_cast<core::Index>(numbers.size()));

  VtpDocument document;
  document.points = loaded.mesh.positions();
  document.polygons = triangle_cells(loaded.mesh.triangles());
  document.point_arrays = {{field_name, outcome.field.values()},
                           {"critical_type", std::span<const std::uint8_t>(types)},
                           {"persistence", std::span<const double>(persistence)},
                           {"input_vertex", std::span<const std::int32_t>(numbers)}};
  const auto labels = [](const std::vector<core::Index>& values) {
    return std::vector<std::int32_t>(values.begin(), values.end());
  };
  const mscomplex::Segmentation& s = m.segmentation;
  const struct {
    const char* name;
    std::vector<std::int32_t> vertex;
    std::vector<std::int32_t> triangle;
  } segments[] = {{"descending", labels(s.descending.vertex), labels(s.descending.triangle)},
                  {"ascending", labels(s.ascending.vertex), labels(s.ascending.triangle)},
                  {"morse_smale", labels(s.morse_smale.vertex), labels(s.morse_smale.triangle)}};
  for (const auto& segment : segments) {
    document.point_arrays.emplace_back(segment.name, std::span<const std::int32_t>(segment.vertex));
    document.cell_arrays.emplace_back(segment.name, std::span<const std::int32_t>(segment.triangle));
  }
  write_vtp(path, document);
}

/// Where a cap is drawn: at the middle of its loop, which has no vertex of its own.
core::Point loop_center(const core::TriangleMesh& mesh, core::Index loop) {
  core::Point sum = core::Point::Zero();
  for (const core::Index h : mesh.boundary_loop(loop)) sum += mesh.position(mesh.origin(h));
  return sum / static_cast<double>(mesh.boundary_loop(loop).size());
}

void write_complex(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                   const MethodOutcome& outcome) {
  using mscomplex::NodeKind;
  const mscomplex::MorseSmaleComplex& complex = outcome.measurement.complex;
  std::vector<core::Point> points;
  std::vector<std::uint8_t>
      kinds;  // 0 minimum, 1 saddle, 2 maximum, 3 cap; 4 descending arc, 5 ascending arc
  std::vector<std::int32_t> vertices;  // a node's critical vertex, an arc's saddle, in the input's numbers
  std::vector<std::int32_t>
      end_vertices;  // where an arc ends, in the input's numbers; −1 for nodes and at caps
  VtpDocument document;
  std::vector<std::int64_t> cell;
  for (core::Index n = 0; n < complex.node_count(); ++n) {
    const mscomplex::Node node = complex.node(n);
    cell = {static_cast<std::int64_t>(points.size())};
    points.push_back(node.kind == NodeKind::cap ? loop_center(loaded.mesh, node.cell)
                                                : loaded.mesh.position(node.vertex));
    document.vertices.add(cell);
    kinds.push_back(static_cast<std::uint8_t>(node.kind));
    vertices.push_back(static_cast<std::int32_t>(loaded.source.numbering.input_vertex(node.vertex)));
    end_vertices.push_back(-1);
  }
  std::vector<core::Point> line;
  for (core::Index a = 0; a < complex.arc_count(); ++a) {
    complex.trace(a, line);
    cell.clear();
    for (const core::Point& p : line) {
      cell.push_back(static_cast<std::int64_t>(points.size()));
      points.push_back(p);
    }
    document.lines.add(cell);
    const mscomplex::Node end = complex.node(complex.arc_end(a));
    kinds.push_back(mscomplex::MorseSmaleComplex::arc_kind(a) == mscomplex::ArcKind::descending ? 4 : 5);
    const core::Index saddle = complex.node(complex.arc_saddle(a)).vertex;
    vertices.push_back(static_cast<std::int32_t>(loaded.source.numbering.input_vertex(saddle)));
    end_vertices.push_back(end.kind == NodeKind::cap
                               ? -1
                               : static_cast<std::int32_t>(loaded.source.numbering.input_vertex(end.vertex)));
  }
  document.points = points;
  document.cell_arrays = {{"kind", std::span<const std::uint8_t>(kinds)},
                          {"vertex", std::span<const std::int32_t>(vertices)},
                          {"end_vertex", std::span<const std::int32_t>(end_vertices)}};
  write_vtp(path, document);
}

void write_points(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                  const MethodOutcome& outcome) {
  const Measurement& m = outcome.measurement;
  const std::vector<double> persistence =
      persistence::vertex_persistence(m.diagram, loaded.mesh.vertex_count());
  core::FileWriter file(path);
  file.write("vertex,x,y,z,type,multiplicity,value,persistence\n");
  for (const morse::CriticalPoint& point : m.critical_points.points) {
    file.write_number(std::uint64_t{loaded.source.numbering.input_vertex(point.vertex)});
    for (const double x : loaded.mesh.position(point.vertex)) {
      file.write(",");
      file.write_number(x);
    }
    file.write("," + std::string(to_string(point.type)) + "," + std::to_string(point.multiplicity) + ",");
    file.write_number(outcome.field.value(point.vertex));
    file.write(",");
    file.write_number(persistence[point.vertex]);  // "inf" where it never dies
    file.write("\n");
  }
  file.commit();
}

}  // namespace

ExportSink::ExportSink(std::filesystem::path folder, const core::LoadedMesh& loaded)
    : folder_(std::move(folder)), loaded_(loaded) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || !std::filesystem::is_directory(folder_))
    throw core::WriteFailed("cannot make the folder " + folder_.string() +
                            (error ? ": " + error.message() : ": a file of that name is there"));
}

void ExportSink::field(const FieldOutcome& outcome) { field_name_ = outcome.name; }

void ExportSink::method(const MethodOutcome& outcome) {
  const int use = ++uses_[outcome.name];
  const std::string name = outcome.name + (use == 1 ? "" : "-" + std::to_string(use));
  write_surface(folder_ / (name + ".surface.vtp"), loaded_, field_name_, outcome);
  write_complex(folder_ / (name + ".complex.vtp"), loaded_, outcome);
  write_points(folder_ / (name + ".points.csv"), loaded_, outcome);
}

}  // namespace morsel::tools
