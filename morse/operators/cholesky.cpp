#include "morsel/morse/operators/cholesky.h"

#include <Eigen/SparseCholesky>
#include <string>

#include "morsel/core/error.h"

namespace morsel::morse {

struct Cholesky::Factor {
  Eigen::SimplicialLDLT<SparseMatrix> solver;
};

Cholesky::Cholesky(const SparseMatrix& matrix, const char* what, const core::Progress& progress) {
  const auto factor = std::make_shared<Factor>();
  progress.update(what, 0);
  factor->solver.analyzePattern(matrix);
  progress.update(what, 0.2);
  factor->solver.factorize(matrix);
  progress.update(what, 1);
  if (factor->solver.info() != Eigen::Success || !factor->solver.vectorD().allFinite())
    throw core::BadInput(
        std::string(what) +
        ": the equations of this mesh have no single solution in floating-point numbers; degenerate "
        "triangles are the usual reason (morsel info names them)");
  factor_ = factor;
}

std::vector<double> Cholesky::solve(std::span<const double> b) const {
  const Eigen::Map<const Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
  std::vector<double> x(b.size());
  Eigen::Map<Eigen::VectorXd>(x.data(), right.size()) = factor_->solver.solve(right);
  return x;
}

}  // namespace morsel::morse
