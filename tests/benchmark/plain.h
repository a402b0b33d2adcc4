#pragma once
/// Each step written down plainly, on one thread, as one would first: baselines, and a check on the results.

#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::benchmark::plain {

/// The edges of the triangles by a hash table; returns their number.
std::size_t edges(std::span<const core::Triangle> triangles);

/// The vertices by value, then by number.
std::vector<core::Index> order(std::span<const double> values);

/// Minima + saddle vertices + maxima of a closed mesh: components of lower and upper link, found triangle by
/// triangle.
std::size_t critical_points(const core::TriangleMesh& mesh, std::span<const core::Index> rank);

/// The number of extremum-saddle pairs of a closed mesh: union-find over all vertices, upwards and downwards.
std::size_t pairs(const core::TriangleMesh& mesh, std::span<const core::Index> rank);

}  // namespace morsel::benchmark::plain
