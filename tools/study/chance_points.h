#pragma once
/// Points that know nothing of a field: what any other choice is to be better than.

#include <cstddef>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/operators/surface_distance.h"
#include "morsel/tools/study/random_stream.h"

namespace morsel::tools {

/// Random vertices that are at least `spacing` apart along the surface, taken in a random order that is
/// weighted by the vertices' areas (Efraimidis, Spirakis 2006): the first is each vertex with a probability
/// that is its share of the area, so that a finer triangulation of a part attracts no points. Fewer than
/// `count` where the surface has no room. `distances` are those of the mesh. O(n log n).
std::vector<core::Index> random_points(const core::TriangleMesh& mesh,
                                       const morse::SurfaceDistances& distances, std::size_t count,
                                       double spacing, RandomStream random);

/// SurfaceDistances::farthest_points() from a random vertex.
std::vector<core::Index> spread_points(const morse::SurfaceDistances& distances, std::size_t count,
                                       RandomStream random);

}  // namespace morsel::tools
