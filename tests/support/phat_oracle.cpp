#include "support/phat_oracle.h"

#include <phat/compute_persistence_pairs.h>
#include <phat/representations/default_representations.h>

#include <algorithm>
#include <array>

namespace morsel::test {

using core::Index;

OracleDiagram phat_diagram(const core::ScalarField& field) {
  const core::TriangleMesh& mesh = field.mesh();
  const Index n = mesh.vertex_count();
  struct Cell {
    Index top;  // highest vertex, or n + loop
    int dimension;
    std::size_t number;  // among all cells, vertices first, then edges, triangles, caps
    std::vector<std::size_t> boundary;
  };
  std::vector<Cell> cells;
  const auto higher = [&](Index a, Index b) { return field.is_lower(a, b) ? b : a; };
  for (Index v = 0; v < n; ++v) cells.push_back({v, 0, v, {}});
  const std::size_t first_edge = n;
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    cells.push_back({higher(a, b), 1, cells.size(), {a, b}});
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& [a, b, c] = mesh.triangle(t);
    Cell cell{higher(a, higher(b, c)), 2, cells.size(), {}};
    for (Index i = 0; i < 3; ++i) cell.boundary.push_back(first_edge + mesh.edge(3 * t + i));
    cells.push_back(cell);
  }
  for (Index loop = 0; loop < mesh.boundary_loop_count(); ++loop) {
    Cell cell{n + loop, 2, cells.size(), {}};
    for (const Index h : mesh.boundary_loop(loop)) cell.boundary.push_back(first_edge + mesh.edge(h));
    cells.push_back(cell);
  }

  const auto height = [&](Index top) { return top < n ? field.rank(top) : top; };
  std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
    return std::make_tuple(height(a.top), a.dimension, a.number) <
           std::make_tuple(height(b.top), b.dimension, b.number);
  });
  std::vector<phat::index> column(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) column[cells[i].number] = static_cast<phat::index>(i);

  phat::boundary_matrix<phat::vector_vector> matrix;
  matrix.set_num_cols(static_cast<phat::index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    phat::column entries;
    for (const std::size_t cell : cells[i].boundary) entries.push_back(column[cell]);
    std::sort(entries.begin(), entries.end());
    matrix.set_dim(static_cast<phat::index>(i), static_cast<phat::dimension>(cells[i].dimension));
    matrix.set_col(static_cast<phat::index>(i), entries);
  }
  phat::persistence_pairs pairs;
  phat::compute_persistence_pairs<phat::twist_reduction>(pairs, matrix);

  OracleDiagram result;
  std::vector<bool> paired(cells.size(), false);
  for (phat::index i = 0; i < pairs.get_num_pairs(); ++i) {
    const auto [birth, death] = pairs.get_pair(i);
    paired[birth] = paired[death] = true;
    if (cells[birth].top != cells[death].top)
      result.pairs.emplace_back(cells[birth].dimension, cells[birth].top, cells[death].top);
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!paired[i]) result.essential.emplace_back(cells[i].dimension, cells[i].top);
  std::sort(result.pairs.begin(), result.pairs.end());
  std::sort(result.essential.begin(), result.essential.end());
  return result;
}

}  // namespace morsel::test
