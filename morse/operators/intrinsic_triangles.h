#pragma once
/// Triangulations of a surface whose edges need not be those of its mesh.

#include <array>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {

/// Triangles by their corners and by the lengths of their sides, which are geodesics; the vertices are the
/// mesh's. A triangle may have the same corner twice, and two vertices be joined by several edges.
struct IntrinsicTriangles {
  std::vector<core::Triangle> corners;
  std::vector<std::array<double, 3>> sides;  ///< side i runs from corner i to corner i + 1 (mod 3)
  std::size_t flips = 0;
};

/// The mesh's own triangles. O(n).
IntrinsicTriangles mesh_triangles(const core::TriangleMesh& mesh, const EdgeLengths& lengths);

/// The intrinsic Delaunay triangulation: inner edges with (cot α + cot β)/2 < 0 are flipped until there is
/// none, each along the surface, which stays as it is (Fisher, Springborn, Bobenko, Schröder 2007, "An
/// algorithm for the construction of intrinsic Delaunay triangulations"). Then no weight of the Laplacian is
/// negative but at boundaries. About O(n) flips on real meshes, serial, the same each time.
IntrinsicTriangles delaunay_triangles(const core::TriangleMesh& mesh, const EdgeLengths& lengths);

/// The cotangent Laplacian of the triangles, as laplacian() is that of edges. `vertices` is their number.
SparseMatrix laplacian(const IntrinsicTriangles& triangles, core::Index vertices);

/// A third of each vertex's triangles.
std::vector<double> barycentric_areas(const IntrinsicTriangles& triangles, core::Index vertices);

}  // namespace morsel::morse
