#include "morsel/tools/export/complex_file.h"

#include <cstdint>
#include <numeric>
#include <span>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools {
namespace {

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

}  // namespace

void write_complex_file(const core::FileTarget& target, const core::LoadedMesh& loaded,
                        const mscomplex::MorseSmaleComplex& complex, const Provenance& provenance,
                        const std::vector<VtpArray>& more) {
  using mscomplex::NodeKind;
  const core::VertexNumbering& numbering = loaded.source.numbering;
  const core::Index nodes = complex.node_count();
  std::vector<core::Point> points(nodes);
  std::vector<std::uint8_t> kinds;
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> end_vertices;
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
  document.cell_arrays.insert(document.cell_arrays.end(), more.begin(), more.end());
  document.provenance = provenance.json();
  write_vtp(target, document, core::Sync::never);
}

}  // namespace morsel::tools
