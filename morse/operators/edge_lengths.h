#pragma once
/// A surface as its edge lengths alone, with no degenerate triangle.

#include <array>
#include <vector>

#include "morsel/core/mesh/mesh.h"

namespace morsel::morse {

/// The lengths l_e, by edge, of triangles that all have an area: l_e = ‖p_i − p_j‖ + ε with the least ε ≥ 0
/// for which the two shorter sides of every triangle are together longer than the third by a millionth of the
/// mean length ("intrinsic mollification": Sharp, Crane 2020, "A Laplacian for nonmanifold triangle meshes",
/// 4.5). ε is 0 on meshes whose angles all exceed about 0.1°, and then nothing is changed.
struct EdgeLengths {
  double unit = 1;              ///< a power of two near the box's diagonal, in the mesh's unit
  std::vector<double> lengths;  ///< l_e in multiples of `unit`
  double added = 0;             ///< ε in multiples of `unit`
  double mean = 0;              ///< the mean of `lengths`

  /// Of the sides of triangle t, from corner i to corner i + 1.
  std::array<double, 3> sides(const core::TriangleMesh& mesh, core::Index t) const {
    return {lengths[mesh.edge(3 * t)], lengths[mesh.edge(3 * t + 1)], lengths[mesh.edge(3 * t + 2)]};
  }
};

/// Throws BadInput if all vertices coincide. O(edges), parallel.
EdgeLengths edge_lengths(const core::TriangleMesh& mesh);

/// Of a triangle with the given sides, in the unit of their square; by Kahan's formula, accurate for needles
/// too.
double triangle_area(const std::array<double, 3>& sides);

/// Half the cotangents of the angles that face the sides of such a triangle.
std::array<double, 3> half_cotangents(const std::array<double, 3>& sides);

/// (cot α + cot β)/2 with the angles that face the edge, by edge. Their Laplacian (laplacian.h) is that of
/// linear finite elements (Pinkall, Polthier 1993), positive semi-definite on every mesh. O(edges), parallel.
std::vector<double> cotangent_weights(const core::TriangleMesh& mesh, const EdgeLengths& lengths);

/// A third of each vertex's triangles, in units squared; all positive. O(triangles), parallel.
std::vector<double> barycentric_areas(const core::TriangleMesh& mesh, const EdgeLengths& lengths);

}  // namespace morsel::morse
