#pragma once
/// The slow reference of mscomplex::shorten().

#include "morsel/mscomplex/cut.h"

namespace morsel::test {

/// The same, in O(paths + edges of the cut + triangles around the two rims, squared at each vertex) an
/// attempt.
mscomplex::ShortenedCut plain_shorten(const core::TriangleMesh& mesh, const mscomplex::CutGraph& cut,
                                      int rounds);

}  // namespace morsel::test
