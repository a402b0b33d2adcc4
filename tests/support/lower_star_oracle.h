#pragma once
/// ProcessLowerStars as the paper prints it, slow and literal: the oracle for the discrete gradient.

#include <map>
#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::test {

/// A vertex, edge or triangle as its sorted vertex numbers.
using Cell = std::vector<core::Index>;
Cell sorted_cell(Cell cell);
Cell edge_cell(const core::TriangleMesh& mesh, core::Index e);
Cell triangle_cell(const core::TriangleMesh& mesh, core::Index t);

struct GradientOracle {
  std::map<Cell, Cell> pairs;  ///< facet to cofacet
  std::vector<Cell> critical;  ///< in the order in which they were found, vertex by vertex
};

/// Robins, Wood, Sheppard 2011, algorithm 1, on the cells of the mesh.
GradientOracle process_lower_stars(const core::ScalarField& field);

}  // namespace morsel::test
