#include "morsel/tools/export/export_sink.h"

#include <array>
#include <functional>
#include <numeric>
#include <span>
#include <system_error>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"
#include "morsel/core/parallel.h"
#include "morsel/tools/export/vtp_writer.h"

namespace morsel::tools {
namespace {

void write_surface(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                   const std::string& field_name, const MethodOutcome& outcome,
                   std::span<const double> persistence) {
  const Measurement& m = outcome.measurement;
  const std::size_t vertices = loaded.mesh.vertex_count();
  const core::VertexNumbering& numbering = loaded.source.numbering;
  std::vector<std::uint8_t> types(vertices, 0);
  for (const morse::CriticalPoint& point : m.critical_points.points)
    types[point.vertex] = static_cast<std::uint8_t>(point.type);

  VtpDocument document;
  document.points = {loaded.mesh.positions()};
  document.polygons = {loaded.mesh.triangles(), vertices};
  document.point_arrays = {{field_name, outcome.field.values()},
                           {"critical_type", std::span<const std::uint8_t>(types)},
                           {"persistence", persistence},
                           {"input_vertex", vertices, numbering.input_count, [&](std::size_t v) {
                              return std::int64_t{numbering.input_vertex(static_cast<core::Index>(v))};
                            }}};
  const auto add = [&](const char* name, const mscomplex::SegmentLabels& segments) {
    document.point_arrays.emplace_back(name, segments.vertex, segments.count);
    document.cell_arrays.emplace_back(name, segments.triangle, segments.count);
  };
  add("descending", m.segmentation.descending);
  add("ascending", m.segmentation.ascending);
  add("morse_smale", m.segmentation.morse_smale);
  write_vtp(path, document, core::Sync::never);
}

/// Where a cap is drawn: at the middle of its loop, which has no vertex of its own.
core::Point loop_center(const core::TriangleMesh& mesh, core::Index loop) {
  core::Point sum = core::Point::Zero();
  for (const core::Index h : mesh.boundary_loop(loop)) sum += mesh.position(mesh.origin(h));
  return sum / static_cast<double>(mesh.boundary_loop(loop).size());
}

/// All arcs of a complex, one after the other.
struct Polylines {
  std::vector<std::vector<core::Point>> points;  // of some arcs each
  std::vector<std::span<const core::Point>> pieces;
  std::vector<std::uint64_t> ends;  // per arc: points of it and those before
};

Polylines trace_arcs(const mscomplex::MorseSmaleComplex& complex) {
  constexpr std::size_t kArcs = 1024;  // traced together
  const std::size_t count = complex.arc_count();
  Polylines result;
  result.points.resize((count + kArcs - 1) / kArcs);
  result.ends.resize(count);
  core::parallel_for(0, count, kArcs, [&](std::size_t first, std::size_t last) {
    std::vector<core::Point>& points = result.points[first / kArcs];
    std::vector<core::Point> line;
    for (std::size_t arc = first; arc < last; ++arc) {
      complex.trace(static_cast<core::Index>(arc), line);
      points.insert(points.end(), line.begin(), line.end());
      result.ends[arc] = line.size();
    }
  });
  std::partial_sum(result.ends.begin(), result.ends.end(), result.ends.begin());
  result.pieces.assign(result.points.begin(), result.points.end());
  return result;
}

void write_complex(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                   const MethodOutcome& outcome) {
  using mscomplex::NodeKind;
  const mscomplex::MorseSmaleComplex& complex = outcome.measurement.complex;
  const core::VertexNumbering& numbering = loaded.source.numbering;
  const core::Index nodes = complex.node_count();
  std::vector<core::Point> points(nodes);
  std::vector<std::uint8_t>
      kinds;  // 0 minimum, 1 saddle, 2 maximum, 3 cap; 4 descending arc, 5 ascending arc
  std::vector<std::int32_t> vertices;  // a node's critical vertex, an arc's saddle, in the input's numbers
  std::vector<std::int32_t>
      end_vertices;  // where an arc ends, in the input's numbers; −1 for nodes and at caps
  for (core::Index n = 0; n < nodes; ++n) {
    const mscomplex::Node node = complex.node(n);
    points[n] =
        node.kind == NodeKind::cap ? loop_center(loaded.mesh, node.cell) : loaded.mesh.position(node.vertex);
    kinds.push_back(static_cast<std::uint8_t>(node.kind));
    vertices.push_back(static_cast<std::int32_t>(numbering.input_vertex(node.vertex)));
    end_vertices.push_back(-1);
  }
  for (core::Index a = 0; a < complex.arc_count(); ++a) {
    const mscomplex::Node end = complex.node(complex.arc_end(a));
    kinds.push_back(mscomplex::MorseSmaleComplex::arc_kind(a) == mscomplex::ArcKind::descending ? 4 : 5);
    const core::Index saddle = complex.node(complex.arc_saddle(a)).vertex;
    vertices.push_back(static_cast<std::int32_t>(numbering.input_vertex(saddle)));
    end_vertices.push_back(
        end.kind == NodeKind::cap ? -1 : static_cast<std::int32_t>(numbering.input_vertex(end.vertex)));
  }
  const Polylines arcs = trace_arcs(complex);

  VtpDocument document;
  document.points = {points};
  document.points.insert(document.points.end(), arcs.pieces.begin(), arcs.pieces.end());
  document.vertices = {nodes, 0, [](std::size_t i) { return static_cast<std::int64_t>(i + 1); }};
  document.lines = {complex.arc_count(), nodes,
                    [&](std::size_t i) { return static_cast<std::int64_t>(arcs.ends[i]); }};
  document.cell_arrays = {{"kind", std::span<const std::uint8_t>(kinds)},
                          {"vertex", std::span<const std::int32_t>(vertices)},
                          {"end_vertex", std::span<const std::int32_t>(end_vertices)}};
  write_vtp(path, document, core::Sync::never);
}

void write_points(const std::filesystem::path& path, const core::LoadedMesh& loaded,
                  const MethodOutcome& outcome, std::span<const double> persistence) {
  core::FileWriter file(path, core::Sync::never);
  file.write("vertex,x,y,z,type,multiplicity,value,persistence,origin\n");
  const std::vector<morse::CriticalPoint>& critical = outcome.measurement.critical_points.points;
  for (std::size_t i = 0; i < critical.size(); ++i) {
    const morse::CriticalPoint& point = critical[i];
    file.write_number(std::uint64_t{loaded.source.numbering.input_vertex(point.vertex)});
    for (const double x : loaded.mesh.position(outcome.places[i])) {
      file.write(",");
      file.write_number(x);
    }
    file.write(",");
    file.write(to_string(point.type));
    file.write(",");
    file.write_number(std::uint64_t{point.multiplicity});
    file.write(",");
    file.write_number(outcome.field.value(point.vertex));
    file.write(",");
    file.write_number(persistence[point.vertex]);  // "inf" where it never dies
    file.write(",");
    if (outcome.origins[i] != core::kNone)
      file.write_number(std::uint64_t{loaded.source.numbering.input_vertex(outcome.origins[i])});
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
  const std::filesystem::path base = folder_ / name;
  const std::vector<double> persistence =
      persistence::vertex_persistence(outcome.measurement.diagram, loaded_.mesh.vertex_count());
  const std::array<std::function<void()>, 3> writers = {
      [&] { write_surface(base.string() + ".surface.vtp", loaded_, field_name_, outcome, persistence); },
      [&] { write_complex(base.string() + ".complex.vtp", loaded_, outcome); },
      [&] { write_points(base.string() + ".points.csv", loaded_, outcome, persistence); }};
  core::parallel_for(0, writers.size(), 1, [&](std::size_t i, std::size_t) { writers[i](); });
}

}  // namespace morsel::tools
