#pragma once
/// Persistence by reducing the boundary matrix (PHAT): the slow reference for everything that pairs.

#include <tuple>
#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::test {

/// A pair or an essential class, by vertices: a cell stands for its highest vertex, a cap for vertex_count +
/// loop. Pairs of cells of one vertex are left out.
struct OracleDiagram {
  /// (dimension of the creating cell, birth vertex, death vertex), sorted.
  std::vector<std::tuple<int, core::Index, core::Index>> pairs;
  /// (dimension, vertex), sorted; a vertex may occur several times.
  std::vector<std::tuple<int, core::Index>> essential;
};

/// Of the lower-star filtration of the capped surface: vertices, edges and triangles by (highest rank,
/// dimension), then the caps, a 2-cell a boundary loop, in the order of the loops.
OracleDiagram phat_diagram(const core::ScalarField& field);

}  // namespace morsel::test
