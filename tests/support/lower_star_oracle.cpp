#include "support/lower_star_oracle.h"

#include <algorithm>
#include <set>
#include <utility>

namespace morsel::test {
namespace {

using core::Index;

bool is_facet(const Cell& facet, const Cell& cell) {
  return facet.size() + 1 == cell.size() &&
         std::includes(cell.begin(), cell.end(), facet.begin(), facet.end());
}

/// The paper's G: the values of a cell's vertices from highest to lowest, compared lexicographically.
std::vector<Index> key(const Cell& cell, const core::ScalarField& field) {
  std::vector<Index> ranks;
  for (const Index v : cell) ranks.push_back(field.rank(v));
  std::sort(ranks.rbegin(), ranks.rend());
  return ranks;
}

void process(const core::ScalarField& field, Index vertex, const std::set<Cell>& lower_star,
             GradientOracle& result) {
  const Cell x = {vertex};
  using Queue = std::set<std::pair<std::vector<Index>, Cell>>;
  const auto entry = [&](const Cell& cell) { return std::pair(key(cell, field), cell); };
  std::set<Cell> done = {x};
  const auto unpaired_facets = [&](const Cell& cell) {
    std::vector<Cell> facets;
    for (const Cell& facet : lower_star)
      if (is_facet(facet, cell) && !done.contains(facet)) facets.push_back(facet);
    return facets;
  };
  const auto pair = [&](const Cell& facet, const Cell& cell) {
    result.pairs[facet] = cell;
    done.insert({facet, cell});
  };

  Queue zero;
  Queue one;
  for (const Cell& cell : lower_star)
    if (cell.size() == 2) zero.insert(entry(cell));
  if (zero.empty()) {
    result.critical.push_back(x);
    return;
  }
  const auto add_cofaces = [&](const Cell& of) {
    for (const Cell& cell : lower_star)
      if (is_facet(of, cell) && !done.contains(cell) && unpaired_facets(cell).size() == 1)
        one.insert(entry(cell));
  };
  const Cell delta = zero.begin()->second;
  zero.erase(zero.begin());
  pair(x, delta);
  add_cofaces(delta);
  while (!one.empty() || !zero.empty()) {
    while (!one.empty()) {
      const Cell alpha = one.begin()->second;
      one.erase(one.begin());
      const std::vector<Cell> facets = unpaired_facets(alpha);
      if (facets.empty()) {
        zero.insert(entry(alpha));
        continue;
      }
      pair(facets.front(), alpha);
      zero.erase(entry(facets.front()));
      add_cofaces(alpha);
      add_cofaces(facets.front());
    }
    if (!zero.empty()) {
      const Cell gamma = zero.begin()->second;
      zero.erase(zero.begin());
      result.critical.push_back(gamma);
      done.insert(gamma);
      add_cofaces(gamma);
    }
  }
}

}  // namespace

Cell sorted_cell(Cell cell) {
  std::sort(cell.begin(), cell.end());
  return cell;
}

Cell edge_cell(const core::TriangleMesh& mesh, Index e) {
  const auto [a, b] = mesh.edge_vertices(e);
  return sorted_cell({a, b});
}

Cell triangle_cell(const core::TriangleMesh& mesh, Index t) {
  const auto& [a, b, c] = mesh.triangle(t);
  return sorted_cell({a, b, c});
}

GradientOracle process_lower_stars(const core::ScalarField& field) {
  const core::TriangleMesh& mesh = field.mesh();
  std::vector<std::set<Cell>> lower_stars(mesh.vertex_count());
  const auto add = [&](const Cell& cell) {
    const Index highest =
        *std::max_element(cell.begin(), cell.end(), [&](Index a, Index b) { return field.is_lower(a, b); });
    lower_stars[highest].insert(sorted_cell(cell));
  };
  for (Index v = 0; v < mesh.vertex_count(); ++v) add({v});
  for (const auto& [a, b, c] : mesh.triangles())
    for (const Cell& cell : {Cell{a, b}, Cell{b, c}, Cell{c, a}, Cell{a, b, c}}) add(cell);
  GradientOracle result;
  for (Index v = 0; v < mesh.vertex_count(); ++v) process(field, v, lower_stars[v], result);
  return result;
}

}  // namespace morsel::test
