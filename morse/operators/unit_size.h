#pragma once
/// Surfaces in a unit of about their own size, so that products of lengths stay in range.

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// A surface whose coordinates were divided by 2^exponent: the largest side of its box is between 1 and 2
/// (the exponent is 0 if all vertices coincide). No digit changes, so what is computed on it scales exactly.
struct UnitSized {
  core::TriangleMesh mesh;
  int exponent;
};

/// Shares the connectivity; O(n), parallel.
UnitSized unit_sized(const core::TriangleMesh& mesh);

}  // namespace morsel::morse
