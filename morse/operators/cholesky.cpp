#include "morsel/morse/operators/cholesky.h"

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <string>
#include <vector>

#include "morsel/core/error.h"

namespace morsel::morse {

/// Eigen's factorisation with checks for a stop in its long loop: the same operations in the same order.
class InterruptibleLdlt : public Eigen::SimplicialLDLT<SparseMatrix> {
 public:
  void factorize(const SparseMatrix& matrix, const char* what, const core::Progress& progress) {
    progress.update(what, 0);
    SparseMatrix permuted(matrix.rows(), matrix.cols());
    const SparseMatrix* preordered = nullptr;
    ordering(matrix, preordered, permuted);
    progress.update(what, 0.1);
    analyzePattern_preordered(*preordered, true);
    progress.update(what, 0.2);
    fill_in(*preordered, what, progress);
    progress.update(what, 1);
  }

 private:
  /// Row by row, each a sparse triangular solve with the rows before (Davis 2005, "Algorithm 849: a concise
  /// sparse Cholesky factorization package").
  void fill_in(const SparseMatrix& matrix, const char* what, const core::Progress& progress) {
    const auto size = static_cast<int>(matrix.cols());
    m_diag.resize(size);
    std::vector<double> row(matrix.cols(), 0.0);  // its entries so far, per column; zeros between rows
    std::vector<int> columns(matrix.cols());
    std::vector<int> seen(matrix.cols(), -1);  // per column: the last row that has an entry there
    const int* const begin = m_matrix.outerIndexPtr();
    int* const inner = m_matrix.innerIndexPtr();
    double* const values = m_matrix.valuePtr();
    constexpr std::int64_t kBetweenChecks = 1 << 22;  // multiplications: some milliseconds
    std::int64_t until_check = kBetweenChecks;
    bool exists = true;
    for (int k = 0; k < size && exists; ++k) {
      int first =
          size;  // the row's columns, each after those on which it depends, are the last ones of `columns`
      seen[k] = k;
      m_nonZerosPerCol[k] = 0;
      for (SparseMatrix::InnerIterator it(matrix, k); it; ++it) {
        int i = static_cast<int>(it.index());
        if (i > k) continue;
        row[i] += it.value();
        int length = 0;
        for (; seen[i] != k; i = m_parent[i]) {
          columns[length++] = i;
          seen[i] = k;
        }
        while (length > 0) columns[--first] = columns[--length];
      }
      double diagonal = row[k];
      row[k] = 0;
      for (; first < size; ++first) {
        const int i = columns[first];
        const double value = row[i];
        row[i] = 0;
        const double entry = value / m_diag[i];
        const int end = begin[i] + m_nonZerosPerCol[i];
        for (int p = begin[i]; p < end; ++p) row[inner[p]] -= values[p] * value;
        diagonal -= entry * value;
        inner[end] = k;
        values[end] = entry;
        ++m_nonZerosPerCol[i];
        until_check -= 8 + m_nonZerosPerCol[i];
      }
      m_diag[k] = diagonal;
      exists = diagonal != 0;
      if (until_check < 0) {
        progress.update(what, 0.2 + 0.8 * k / size);
        until_check = kBetweenChecks;
      }
    }
    m_info = exists ? Eigen::Success : Eigen::NumericalIssue;
    m_factorizationIsOk = true;
  }
};

struct Cholesky::Factor {
  InterruptibleLdlt solver;
};

Cholesky::Cholesky(const SparseMatrix& matrix, const char* what, const core::Progress& progress) {
  const auto factor = std::make_shared<Factor>();
  factor->solver.factorize(matrix, what, progress);
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
