#pragma once
/// Factorise once, solve many times.

#include <memory>
#include <span>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {

/// The factorisation L D Lᵀ of a symmetric matrix after a fill-reducing (minimum degree) renumbering; by
/// Eigen. Copies share it. Solving may be done from several threads at once.
class Cholesky {
 public:
  /// `matrix` must be symmetric and definite, of either sign; an indefinite one (a shifted Laplacian) usually
  /// has a factorisation too. About n^1.5 on surfaces, serial. Throws BadInput, naming `what` is solved, if
  /// there is none.
  explicit Cholesky(const SparseMatrix& matrix, const char* what, const core::Progress& progress = {});

  /// The solution of matrix · x = b; both have one entry per row. O(n log n).
  std::vector<double> solve(std::span<const double> b) const;

 private:
  struct Factor;
  std::shared_ptr<const Factor> factor_;
};

}  // namespace morsel::morse
