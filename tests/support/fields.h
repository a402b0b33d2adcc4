#pragma once
/// Seeded fields for the tests, generic and degenerate ones.

#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::test {

std::vector<double> random_values(std::size_t count, unsigned seed);  ///< distinct, in [0, 1)
std::vector<double> tied_values(std::size_t count, int levels,
                                unsigned seed);  ///< `levels` distinct whole numbers, from 0 on
/// Random values averaged over neighbours a few times, then rounded to `levels` distinct values: plateaus.
std::vector<double> plateau_values(const core::TriangleMesh& mesh, int levels, unsigned seed);
std::vector<double> smooth_values(const core::TriangleMesh& mesh, int rounds, unsigned seed);

struct NamedField {
  std::string name;
  core::ScalarField field;
};

/// Random, tied (2 and 5 distinct values), plateaus, smooth, constant, and one per coordinate, on one mesh.
std::vector<NamedField> field_zoo(const core::TriangleMesh& mesh, unsigned seed);

}  // namespace morsel::test
