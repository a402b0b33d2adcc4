#include "morsel/morse/operators/modes.h"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/morse/operators/cholesky.h"

namespace morsel::morse::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Matrices up to this size are small; so are larger ones of which a good part of the modes is wanted.
constexpr Index kSmall = 256;
constexpr Index kMostDense = 2048;

/// The shift, where the lowest eigenvalue of a round surface is 8π: without the constants, which are
/// projected out, it only has to keep the matrix from being singular.
constexpr double kShift = 1e-3;

constexpr double kAccuracy = 1e-12;  ///< residuals, relative to the inverse's eigenvalues
constexpr Index kRestarts = 1000;

[[noreturn]] void refuse() {
  throw core::BadInput(
      "the eigenfunctions of this mesh do not converge; degenerate triangles are the usual reason (morsel "
      "info names "
      "them)");
}

/// How many of the ascending values are wanted: `count`, and those that equal the last.
Index wanted(const VectorXd& values, Index count) {
  while (count < values.size() && values[count] <= values[count - 1] * (1 + kSameEigenvalue)) ++count;
  return count;
}

Modes dense_modes(const SparseMatrix& laplacian, const VectorXd& root, Index count) {
  const VectorXd inverse = root.cwiseInverse();
  MatrixXd matrix = inverse.asDiagonal() * MatrixXd(laplacian) * inverse.asDiagonal();
  // The constant mode moves to the upper end.
  const double top = 2 * matrix.cwiseAbs().rowwise().sum().maxCoeff();
  matrix += (top / root.squaredNorm()) * root * root.transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success) refuse();
  const Index n = wanted(solver.eigenvalues().head(root.size() - 1), count);
  return {solver.eigenvalues().head(n), solver.eigenvectors().leftCols(n)};
}

/// y = P M^½ (L + shift · M)⁻¹ M^½ x, with P projecting out the modes found.
class ShiftedInverse {
 public:
  using Scalar = double;

  ShiftedInverse(const SparseMatrix& laplacian, VectorXd root, const core::Progress& progress)
      : root_(std::move(root)),
        factor_(shifted(laplacian, root_), "eigenfunctions", progress),
        progress_(progress) {
    found_ = root_.normalized();
  }

  Index rows() const { return root_.size(); }
  Index cols() const { return root_.size(); }

  void perform_op(const double* x, double* y) const {
    progress_.throw_if_cancelled();
    const VectorXd right = root_.cwiseProduct(Eigen::Map<const VectorXd>(x, rows()));
    const std::vector<double> solved = factor_.solve({right.data(), static_cast<std::size_t>(right.size())});
    Eigen::Map<VectorXd> result(y, rows());
    result = root_.cwiseProduct(Eigen::Map<const VectorXd>(solved.data(), rows()));
    project(result);
  }

  /// Twice, to remove the rounding of the first time too.
  template <class Vector>
  void project(Vector& x) const {
    for (int pass = 0; pass < 2; ++pass) x -= found_ * (found_.transpose() * x).eval();
  }

  void add_found(const MatrixXd& vectors) {
    const Index before = found_.cols();
    found_.conservativeResize(Eigen::NoChange, before + vectors.cols());
    found_.rightCols(vectors.cols()) = vectors;
  }

 private:
  static SparseMatrix shifted(const SparseMatrix& laplacian, const VectorXd& root) {
    SparseMatrix matrix = laplacian;
    for (Index v = 0; v < root.size(); ++v) matrix.coeffRef(v, v) += kShift * root[v] * root[v];
    return matrix;
  }

  VectorXd root_;
  Cholesky factor_;
  const core::Progress& progress_;
  MatrixXd found_;
};

/// The lowest modes of one Krylov space, ascending.
Modes lanczos(ShiftedInverse& inverse, Index count, std::mt19937& random) {
  const Index n = inverse.rows();
  VectorXd start(n);
  for (double& x : start) x = static_cast<double>(random()) / 4294967296.0 - 0.5;
  inverse.project(start);
  const Index space = std::min(n, count + count / 2 + 20);  // fastest in measurements
  Spectra::SymEigsSolver<ShiftedInverse> solver(inverse, count, space);
  solver.init(start.data());
  solver.compute(Spectra::SortRule::LargestAlge, kRestarts, kAccuracy, Spectra::SortRule::LargestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) refuse();
  return {(solver.eigenvalues().cwiseInverse().array() - kShift).matrix(), solver.eigenvectors()};
}

/// Adds `more`, keeping the values ascending.
void merge(Modes& all, const Modes& more) {
  const Index before = all.values.size();
  const Index after = before + more.values.size();
  std::vector<std::pair<double, Index>> order;
  for (Index k = 0; k < after; ++k)
    order.emplace_back(k < before ? all.values[k] : more.values[k - before], k);
  std::sort(order.begin(), order.end());
  Modes both{VectorXd(after), MatrixXd(all.vectors.rows(), after)};
  for (Index k = 0; k < after; ++k) {
    const Index from = order[static_cast<std::size_t>(k)].second;
    both.values[k] = order[static_cast<std::size_t>(k)].first;
    if (from < before)
      both.vectors.col(k) = all.vectors.col(from);
    else
      both.vectors.col(k) = more.vectors.col(from - before);
  }
  all = std::move(both);
}

Modes sparse_modes(const SparseMatrix& laplacian, const VectorXd& root, Index count,
                   const core::Progress& progress) {
  ShiftedInverse inverse(laplacian, root, progress);
  std::mt19937 random(1);  // the same start each time
  progress.update("eigenfunctions", 0.2);
  Modes all = lanczos(inverse, count, random);
  inverse.add_found(all.vectors);
  for (Index more = 1;; more = std::min(2 * more, count)) {
    progress.update("eigenfunctions", 0.8);
    const Modes left = lanczos(inverse, more, random);
    if (left.values[0] > all.values[count - 1] * (1 + kSameEigenvalue)) break;
    inverse.add_found(left.vectors);
    merge(all, left);
  }
  const Index n = wanted(all.values, count);
  return {all.values.head(n), all.vectors.leftCols(n)};
}

}  // namespace

Modes lowest_modes(const SparseMatrix& laplacian, std::span<const double> mass, Index count,
                   const core::Progress& progress) {
  const Index n = laplacian.rows();
  const VectorXd root = Eigen::Map<const VectorXd>(mass.data(), n).cwiseSqrt();
  const bool dense = n <= kSmall || (n <= kMostDense && 3 * count > n);
  return dense ? dense_modes(laplacian, root, count) : sparse_modes(laplacian, root, count, progress);
}

}  // namespace morsel::morse::detail
