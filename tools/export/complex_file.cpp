#include "morsel/tools/export/complex_file.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/export/complex_nodes.h"
#include "morsel/tools/export/finite_persistence.h"

namespace morsel::tools {
namespace {

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

void write_complex_file(const core::FileTarget& target, const ComplexFile& file, const Provenance& provenance,
                        const std::vector<VtpArray>& more) {
  using mscomplex::NodeKind;
  const mscomplex::MorseSmaleComplex& complex = file.complex;
  const core::VertexNumbering& numbering = file.loaded.source.numbering;
  const core::Index nodes = complex.node_count();
  const double extent = file.field.extent();
  std::vector<core::Point> points(nodes);
  std::vector<std::uint8_t> kinds;
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> end_vertices;
  std::vector<double> values;
  std::vector<double> end_values;
  FinitePersistence persistence;
  for (core::Index n = 0; n < nodes; ++n) {
    const mscomplex::Node node = complex.node(n);
    points[n] = place_of(file.loaded.mesh, node);
    kinds.push_back(static_cast<std::uint8_t>(node.kind));
    vertices.push_back(static_cast<std::int32_t>(numbering.input_vertex(node.vertex)));
    end_vertices.push_back(-1);
    values.push_back(finite_value(node, file.field));
    end_values.push_back(values.back());
    persistence.add(persistence_of(node, file.persistence), extent);
  }
  for (core::Index a = 0; a < complex.arc_count(); ++a) {
    const mscomplex::Node end = complex.node(complex.arc_end(a));
    const mscomplex::Node saddle = complex.node(complex.arc_saddle(a));
    kinds.push_back(mscomplex::MorseSmaleComplex::arc_kind(a) == mscomplex::ArcKind::descending ? 4 : 5);
    vertices.push_back(static_cast<std::int32_t>(numbering.input_vertex(saddle.vertex)));
    end_vertices.push_back(
        end.kind == NodeKind::cap ? -1 : static_cast<std::int32_t>(numbering.input_vertex(end.vertex)));
    values.push_back(saddle.value);
    end_values.push_back(finite_value(end, file.field));
    persistence.add(std::abs(end.value - saddle.value), extent);
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
                          {"end_vertex", std::span<const std::int32_t>(end_vertices)},
                          {"value", std::span<const double>(values)},
                          {"end_value", std::span<const double>(end_values)},
                          {"persistence", std::span<const double>(persistence.values)},
                          {"essential", std::span<const std::uint8_t>(persistence.essential)}};
  document.cell_arrays.insert(document.cell_arrays.end(), more.begin(), more.end());
  document.provenance = provenance.json();
  write_vtp(target, document, core::Sync::never);
}

void write_nodes_file(const core::FileTarget& target, const ComplexFile& file, const Provenance& provenance) {
  const core::VertexNumbering& numbering = file.loaded.source.numbering;
  std::vector<core::Point> points;
  std::vector<std::int32_t> types;
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> multiplicities;
  std::vector<double> values;
  FinitePersistence persistence;
  mscomplex::Node before;
  for (core::Index n = 0; n < file.complex.node_count(); ++n) {
    const mscomplex::Node node = file.complex.node(n);
    // The nodes of a multiple saddle come one after the other.
    if (n > 0 && node.kind == mscomplex::NodeKind::saddle && before.kind == node.kind &&
        before.vertex == node.vertex) {
      ++multiplicities.back();
      continue;
    }
    before = node;
    points.push_back(place_of(file.loaded.mesh, node));
    types.push_back(static_cast<std::int32_t>(node.kind));
    vertices.push_back(static_cast<std::int32_t>(numbering.input_vertex(node.vertex)));
    multiplicities.push_back(1);
    values.push_back(finite_value(node, file.field));
    persistence.add(persistence_of(node, file.persistence), file.field.extent());
  }
  VtpDocument document;
  document.points = {points};
  document.vertices = {points.size(), 0, [](std::size_t i) { return static_cast<std::int64_t>(i + 1); }};
  document.point_arrays = {{"CriticalType", std::span<const std::int32_t>(types)},
                           {"VertexId", std::span<const std::int32_t>(vertices)},
                           {"Multiplicity", std::span<const std::int32_t>(multiplicities)},
                           {file.field_name, std::span<const double>(values)},
                           {"Persistence", std::span<const double>(persistence.values)},
                           {"Essential", std::span<const std::uint8_t>(persistence.essential)}};
  document.cell_arrays = document.point_arrays;
  document.provenance = provenance.json();
  write_vtp(target, document, core::Sync::never);
}

}  // namespace morsel::tools
