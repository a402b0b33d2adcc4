#pragma once
/// The lowest modes of one component. For eigenfunctions.cpp.

#include <Eigen/Core>
#include <span>

#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse::detail {

/// Eigenvalues that differ by at most this share count as equal.
inline constexpr double kSameEigenvalue = 1e-8;

/// y with (M^-½ L M^-½) y = λ y, a column each by ascending λ, orthonormal.
struct Modes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Modes of the Laplacian L, positive semi-definite with the constants as its kernel, and the diagonal M of
/// the positive `mass`, which sums to about 1: the `count` lowest without the constant one, and all whose
/// eigenvalues equal the last of these; `count` < rows. Of equal eigenvalues all are found, the basis is
/// arbitrary but the same each time.
///
/// A dense solver for small matrices, else Lanczos on the inverse with a small shift (Spectra), repeated on
/// the orthogonal complement of all modes found until it has no lower ones: one Krylov space contains one
/// mode of each eigenvalue only. Serial. Throws BadInput if it does not converge.
Modes lowest_modes(const SparseMatrix& laplacian, std::span<const double> mass, Eigen::Index count,
                   const core::Progress& progress);

}  // namespace morsel::morse::detail
