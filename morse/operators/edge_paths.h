#pragma once
/// Distances along edges, and farthest-point sampling by them.

#include <cstddef>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// The length of the shortest path along edges from each vertex to the nearest source, infinite where there
/// is none (Dijkstra 1959): an upper bound of the geodesic distance. O(n log n), serial.
std::vector<double> edge_distances(const core::TriangleMesh& mesh, std::span<const core::Index> sources);

/// Vertices spread over a connected mesh.
struct FarthestPoints {
  std::vector<core::Index> points;
  std::vector<core::Index> nearest;  ///< per vertex: the number in `points` of the nearest one
  double reach = 0;                  ///< how far the first point is from the vertex farthest from it
};

/// Farthest-point sampling: the first point is the vertex farthest from the surface's centre of gravity, each
/// next one the vertex farthest, along edges, from all points before; ties go to the smallest vertex. `count`
/// points (≥ 1), fewer when every vertex is at one of them. Vertex numbers matter in ties only. About O(n
/// log n log count), serial.
FarthestPoints farthest_points(const core::TriangleMesh& mesh, std::size_t count);

}  // namespace morsel::morse
