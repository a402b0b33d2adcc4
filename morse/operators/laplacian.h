#pragma once
/// The Laplacian of a triangle mesh, its weights and its vertices' areas.

#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/text/parameters.h"

namespace morsel::morse {

/// A sparse matrix, one row and one column per vertex, stored by columns with ascending rows.
using SparseMatrix = Eigen::SparseMatrix<double>;

enum class EdgeWeights : std::uint8_t {
  cotangent,  ///< (cot α + cot β)/2 with the angles that face the edge: linear finite elements (Pinkall,
              ///< Polthier 1993)
  clamped,    ///< the same, but at least kLeastWeight: a maximum principle, at the price of some accuracy
  uniform     ///< 1: the graph's Laplacian
};

/// "cotangent", "clamped", "uniform".
std::string_view to_string(EdgeWeights weights);

/// The key `weights` with one of these names.
EdgeWeights read_edge_weights(core::ParameterReader& reader, EdgeWeights default_weights);

/// The lower bound of clamped weights. An edge between two right angles has weight 0.
inline constexpr double kLeastWeight = 1e-3;

/// w_e of each edge, by number; no unit. Cotangents are those of edge_lengths.h, so that degenerate triangles
/// are allowed; throws BadInput as edge_lengths() does. O(edges), parallel.
std::vector<double> edge_weights(const core::TriangleMesh& mesh, EdgeWeights weights);

/// The symmetric matrix L with (L f)_i = Σ_j w_ij (f_i − f_j): positive semi-definite where no weight is
/// negative and for cotangents, its kernel the functions that are constant on each component. Natural
/// (Neumann) conditions at boundaries. O(edges).
SparseMatrix laplacian(const core::TriangleMesh& mesh, std::span<const double> edge_weights);

enum class VertexArea : std::uint8_t {
  barycentric,  ///< a third of each triangle
  mixed  ///< Voronoi parts, and halves and quarters of obtuse triangles (Meyer, Desbrun, Schröder, Barr
         ///< 2003, 3.3)
};

/// The part of the surface that belongs to each vertex, in squared units of length; sums to the surface's
/// area. 0 where all triangles of a vertex have no area. O(triangles), parallel.
std::vector<double> vertex_areas(const core::TriangleMesh& mesh, VertexArea kind);

/// M + tL of an implicit step of the heat equation, with M the areas. O(edges).
SparseMatrix heat_matrix(const SparseMatrix& laplacian, std::span<const double> areas, double time);

}  // namespace morsel::morse
