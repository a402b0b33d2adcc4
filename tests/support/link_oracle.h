#pragma once
/// Critical points from the definition: the components of lower and upper links, on the capped surface.

#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::test {

/// Components of a vertex's lower and upper link. Regular: 1 and 1; minimum: 0 and 1; maximum: 1 and 0;
/// saddle of multiplicity k − 1: k and k.
struct LinkComponents {
  int lower = 0;
  int upper = 0;
};

/// Per vertex, from triangles and values alone (values compared, then vertex numbers); O(n · degree).
std::vector<LinkComponents> link_components(const core::TriangleMesh& mesh,
                                            const std::vector<double>& values);

}  // namespace morsel::test
