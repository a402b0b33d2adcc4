#pragma once
/// The vibrations of a surface: eigenfunctions of its Laplacian.

#include <cstddef>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

/// One solution of L φ = λ M φ.
struct Eigenfunction {
  double eigenvalue;        ///< λ > 0, in 1/length²
  double residual;          ///< ‖M⁻¹ L φ − λ φ‖ in the norm of M, in 1/length²
  core::Index component;    ///< of the mesh: φ is 0 outside of it
  std::vector<double> phi;  ///< per vertex, φᵀ M φ = 1, in 1/length
};

/// How many of them are not constant on a component: vertices − components.
core::Index nonconstant_eigenfunction_count(const core::TriangleMesh& mesh);

/// Of the generalised eigenproblem with the cotangent Laplacian L of linear finite elements and the diagonal
/// M of each vertex's third of its triangles' areas, the `count` functions with the smallest λ, ascending;
/// constants (λ = 0, one for each component) are left out. They are orthonormal in M and orthogonal to the
/// constants. At boundaries the conditions are natural (Neumann: no flux). Triangles without area get one as
/// edge_lengths.h says.
///
/// What the equation leaves open is fixed so that mesh and vertex numbers alone determine the result:
/// - Every function has its support on one component. Equal eigenvalues (within 1e-8 of their size) of
///   different components are ordered by component.
/// - Equal eigenvalues of one component, as symmetries cause, determine a space only; its basis is chosen so:
///   v is the vertex with the largest Σ φ² over the basis (the smallest of those within 1e-6 of it), the
///   first function is the one that is largest at v, and the rest, which is 0 at v, is treated likewise. A
///   single function is thus positive where it is largest in magnitude.
///
/// n^1.5 for a factorisation, then about n log n for each function and n `count`² for keeping them
/// orthogonal; memory of some 20 n `count` bytes. Serial, the same bits each time. Throws BadInput if `count`
/// is more than nonconstant_eigenfunction_count(), if the surface has no extent and if the iteration does not
/// converge.
std::vector<Eigenfunction> eigenfunctions(const core::TriangleMesh& mesh, std::size_t count,
                                          const core::Progress& progress = {});

}  // namespace morsel::morse
