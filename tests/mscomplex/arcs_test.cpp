// The arcs of the complex: where they go, in what order they arrive, and their geometry.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "morsel/mscomplex/complex.h"
#include "support/complex_oracle.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using mscomplex::ArcKind;
using mscomplex::MorseSmaleComplex;
using mscomplex::Node;
using mscomplex::NodeKind;

namespace {

/// The node's cell in the oracle's terms; a cap is its loop's smallest vertex.
Cell node_cell(const MorseSmaleComplex& complex, Index n) {
  const Node node = complex.node(n);
  if (node.kind == NodeKind::maximum) return triangle_cell(complex.mesh(), node.cell);
  if (node.kind != NodeKind::saddle) return {node.vertex};
  return edge_cell(complex.mesh(), node.cell);
}

ComplexOracle::ArcName arc_name(const MorseSmaleComplex& complex, Index arc) {
  const TriangleMesh& mesh = complex.mesh();
  const Cell edge = node_cell(complex, complex.arc_saddle(arc));
  const Index h = mesh.edge_halfedge(complex.node(complex.arc_saddle(arc)).cell);
  const auto beside = [&](Index side) {
    return side == kNone ? node_cell(complex, complex.arc_end(arc))
                         : triangle_cell(mesh, TriangleMesh::triangle_of(side));
  };
  switch (arc % 4) {
    case 0:
      return {edge, Cell{mesh.origin(h)}};
    case 1:
      return {edge, beside(mesh.twin(h))};
    case 2:
      return {edge, Cell{mesh.target(h)}};
    default:
      return {edge, beside(h)};
  }
}

/// Ends, paths and cyclic orders compared with the oracle's.
void check_against_oracle(const MorseSmaleComplex& complex, const ComplexOracle& oracle) {
  const TriangleMesh& mesh = complex.mesh();
  std::vector<Index> cells;
  for (Index a = 0; a < complex.arc_count(); ++a) {
    const auto [edge, start] = arc_name(complex, a);
    complex.trace_cells(a, cells);
    const Cell end = node_cell(complex, complex.arc_end(a));
    if (MorseSmaleComplex::arc_kind(a) == ArcKind::descending) {
      std::vector<Index> way = oracle.way_down(start.front());
      const Index vertex = complex.node(complex.arc_saddle(a)).vertex;
      if (start.front() != vertex) way.insert(way.begin(), vertex);
      REQUIRE(cells == way);
      REQUIRE(end == Cell{way.back()});
    } else if (start.size() == 3) {
      std::vector<Cell> way;
      for (const Index t : cells) way.push_back(triangle_cell(mesh, t));
      REQUIRE(way == oracle.way_up(start));
      REQUIRE(end == oracle.top(start));
    } else {
      REQUIRE(cells.empty());
      REQUIRE(oracle.triangles_at(edge).size() == 1);
      REQUIRE(end == oracle.cap_at(edge));
    }
  }
  for (Index n = 0; n < complex.node_count(); ++n) {
    const Node node = complex.node(n);
    if (node.kind == NodeKind::saddle) continue;
    std::vector<ComplexOracle::ArcName> found;
    for (const Index a : complex.arcs_ending_at(n)) found.push_back(arc_name(complex, a));
    std::vector<ComplexOracle::ArcName> expected =
        node.kind == NodeKind::minimum   ? oracle.around_minimum(node.vertex)
        : node.kind == NodeKind::maximum ? oracle.around_maximum(node.cell)
                                         : oracle.around_cap(node.cell);
    REQUIRE(found.size() == expected.size());
    if (found.empty()) continue;
    const auto first = std::find(expected.begin(), expected.end(), found.front());
    REQUIRE(first != expected.end());
    std::rotate(expected.begin(), first, expected.end());
    REQUIRE(found == expected);
  }
}

bool near(const Point& a, const Point& b) { return (a - b).norm() < 1e-12; }

}  // namespace

TEST_CASE("arcs and cyclic orders are those of plain tracing") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {31u, 32u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        check_against_oracle(MorseSmaleComplex(f.field), ComplexOracle(f.field));
      }
}

TEST_CASE("an arc is a chain of neighbours from its saddle to its end") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 41)) {
      INFO(entry.name << " | " << f.name);
      const MorseSmaleComplex complex(f.field);
      const TriangleMesh& mesh = entry.mesh;
      const auto corners = [&](Index t) {
        const auto& [a, b, c] = mesh.triangle(t);
        return std::array{mesh.position(a), mesh.position(b), mesh.position(c)};
      };
      std::vector<Index> cells;
      std::vector<Point> points;
      for (Index a = 0; a < complex.arc_count(); ++a) {
        complex.trace_cells(a, cells);
        complex.trace(a, points);
        const Node saddle = complex.node(complex.arc_saddle(a));
        const Node end = complex.node(complex.arc_end(a));
        REQUIRE(points.size() >= 2);
        REQUIRE(near(points.front(), mesh.position(saddle.vertex)));
        if (end.kind != NodeKind::cap) REQUIRE(near(points.back(), mesh.position(end.vertex)));
        if (MorseSmaleComplex::arc_kind(a) == ArcKind::descending) {
          REQUIRE(points.size() == cells.size());
          std::vector<Index> ring;
          for (std::size_t i = 0; i < cells.size(); ++i) {
            REQUIRE(near(points[i], mesh.position(cells[i])));
            if (i == 0) continue;
            mesh.neighbors(cells[i], ring);
            REQUIRE(std::find(ring.begin(), ring.end(), cells[i - 1]) != ring.end());
            REQUIRE(f.field.is_lower(cells[i], cells[i - 1]));
          }
          continue;
        }
        // Saddle, then a barycentre and the midpoint of a side for each triangle, the last side's place taken
        // by the maximum.
        REQUIRE(points.size() == (cells.empty() ? 2 : 1 + 2 * cells.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) {
          const auto here = corners(cells[i]);
          REQUIRE(near(points[2 * i + 1], (here[0] + here[1] + here[2]) / 3));
          const bool last = i + 1 == cells.size();
          if (last && end.kind == NodeKind::maximum) continue;
          bool on_side = false;
          for (int k = 0; k < 3; ++k) {
            const Index h = 3 * cells[i] + static_cast<Index>(k);
            if (!near((here[k] + here[(k + 1) % 3]) / 2, points[2 * i + 2])) continue;
            const Index across = mesh.twin(h);
            on_side =
                last ? across == kNone : across != kNone && TriangleMesh::triangle_of(across) == cells[i + 1];
          }
          REQUIRE(on_side);
        }
      }
    }
}
