#include "morsel/morse/operators/eigenfunctions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/morse/operators/edge_lengths.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/modes.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::TriangleMesh;
using detail::Modes;

/// Values within these shares of the largest count as equal to it.
constexpr double kAsLarge = 1e-6;

/// One component of the mesh with the area 1.
struct Piece {
  std::vector<Index> vertices;  // ascending
  SparseMatrix laplacian;
  std::vector<double> mass;  // per vertex of the piece
  double area = 0;           // in the mesh's unit
};

std::vector<Piece> pieces_of(const TriangleMesh& mesh) {
  const EdgeLengths lengths = edge_lengths(mesh);
  const SparseMatrix whole = laplacian(mesh, cotangent_weights(mesh, lengths));
  const std::vector<double> areas = barycentric_areas(mesh, lengths);
  std::vector<Piece> pieces(mesh.component_count());
  std::vector<int> number(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Piece& piece = pieces[mesh.component_of_vertex(v)];
    number[v] = static_cast<int>(piece.vertices.size());
    piece.vertices.push_back(v);
    piece.mass.push_back(areas[v]);
    piece.area += areas[v];
  }
  for (Piece& piece : pieces) {
    for (double& m : piece.mass) m /= piece.area;
    piece.area *= lengths.unit * lengths.unit;
    const auto n = static_cast<int>(piece.vertices.size());
    std::vector<Eigen::Triplet<double, int>> entries;
    for (int column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator it(whole, static_cast<int>(piece.vertices[column])); it; ++it)
        entries.emplace_back(number[static_cast<Index>(it.row())], column, it.value());
    piece.laplacian.resize(n, n);
    piece.laplacian.setFromTriplets(entries.begin(), entries.end());
  }
  return pieces;
}

/// Rotates columns [first, last), a basis of functions of one eigenvalue, as eigenfunctions() says.
void settle_basis(Eigen::MatrixXd& phi, Eigen::Index first, Eigen::Index last) {
  for (; first < last; ++first) {
    auto basis = phi.middleCols(first, last - first);
    const Eigen::VectorXd size = basis.rowwise().squaredNorm();
    const double largest = size.maxCoeff();
    Eigen::Index v = 0;
    while (size[v] < largest * (1 - kAsLarge)) ++v;
    // A reflection of the columns that brings all of row v into the first.
    Eigen::RowVectorXd row = basis.row(v);
    const double length = row.norm();
    const double rest = row.tail(row.size() - 1).squaredNorm();
    row[0] = row[0] > 0 ? -rest / (row[0] + length) : row[0] - length;  // row[0] − length, not cancelled
    if (const double squared = row.squaredNorm(); squared > 0)
      basis -= (basis * row.transpose() * (2 / squared)).eval() * row;
  }
}

/// λ and residual of a function φ that is orthonormal in M, by differences, which do not cancel.
std::pair<double, double> quotient(const Piece& piece, const Eigen::VectorXd& phi) {
  Eigen::VectorXd image = Eigen::VectorXd::Zero(phi.size());
  double energy = 0;
  double norm = 0;
  for (int column = 0; column < piece.laplacian.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(piece.laplacian, column); it; ++it) {
      const double flow = -it.value() * (phi[column] - phi[it.row()]);
      image[column] += flow;
      energy += flow * (phi[column] - phi[it.row()]) / 2;
    }
    norm += piece.mass[column] * phi[column] * phi[column];
  }
  const double value = energy / norm;
  double residual = 0;
  for (Eigen::Index v = 0; v < phi.size(); ++v) {
    const double m = piece.mass[static_cast<std::size_t>(v)];
    residual += (image[v] - value * m * phi[v]) * (image[v] - value * m * phi[v]) / m;
  }
  return {value, std::sqrt(residual)};
}

bool is_same(double lower, double higher) { return higher <= lower * (1 + detail::kSameEigenvalue); }

/// A function on its own component, of area 1.
struct Candidate {
  double value;
  double residual;
  Index component;
  Eigen::VectorXd phi;
};

/// Appends the lowest functions of one component, and all of the last one's eigenvalue.
void add_candidates(const Piece& piece, Index component, std::size_t count, std::vector<Candidate>& all,
                    const core::Progress& progress) {
  const Eigen::Map<const Eigen::VectorXd> mass(piece.mass.data(), piece.laplacian.rows());
  const Modes modes =
      detail::lowest_modes(piece.laplacian, piece.mass, static_cast<Eigen::Index>(count), progress);
  Eigen::MatrixXd phi = mass.cwiseSqrt().cwiseInverse().asDiagonal() * modes.vectors;
  for (Eigen::Index first = 0, last = 0; first < phi.cols(); first = last) {
    for (last = first + 1; last < phi.cols() && is_same(modes.values[last - 1], modes.values[last]);) ++last;
    settle_basis(phi, first, last);
    double mean = 0;
    for (Eigen::Index k = first; k < last; ++k) {
      const auto [value, residual] = quotient(piece, phi.col(k));
      mean += value / static_cast<double>(last - first);
      all.push_back({value, residual, component, phi.col(k)});
    }
    for (auto same = all.end() - (last - first); same != all.end(); ++same) same->value = mean;
  }
}

/// By eigenvalue; equal ones by component, each component's in their own order.
void sort(std::vector<Candidate>& all, const std::vector<Piece>& pieces) {
  const auto value = [&](const Candidate& one) { return one.value / pieces[one.component].area; };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Candidate& a, const Candidate& b) { return value(a) < value(b); });
  for (auto first = all.begin(); first != all.end();) {
    auto last = first + 1;
    while (last != all.end() && is_same(value(*(last - 1)), value(*last))) ++last;
    std::stable_sort(first, last,
                     [](const Candidate& a, const Candidate& b) { return a.component < b.component; });
    first = last;
  }
}

}  // namespace

Index nonconstant_eigenfunction_count(const TriangleMesh& mesh) {
  return mesh.vertex_count() - mesh.component_count();
}

std::vector<Eigenfunction> eigenfunctions(const TriangleMesh& mesh, std::size_t count,
                                          const core::Progress& progress) {
  const Index most = nonconstant_eigenfunction_count(mesh);
  if (count > most)
    throw core::BadInput("eigenfunction " + std::to_string(count) + " does not exist: this mesh has " +
                         std::to_string(most) + " (1 to " + std::to_string(most) +
                         ") that are not constant, its vertices less its components");
  std::vector<Eigenfunction> result;
  if (count == 0) return result;
  const std::vector<Piece> pieces = pieces_of(mesh);
  std::vector<Candidate> all;
  for (Index c = 0; c < pieces.size(); ++c) {
    progress.update("eigenfunctions", static_cast<double>(c) / static_cast<double>(pieces.size()));
    add_candidates(pieces[c], c, std::min(count, pieces[c].vertices.size() - 1), all, progress);
  }
  sort(all, pieces);
  all.resize(count);
  for (const Candidate& one : all) {
    const Piece& piece = pieces[one.component];
    std::vector<double> phi(mesh.vertex_count(), 0.0);
    for (std::size_t i = 0; i < piece.vertices.size(); ++i)
      phi[piece.vertices[i]] = one.phi[static_cast<Eigen::Index>(i)] / std::sqrt(piece.area);
    result.push_back({one.value / piece.area, one.residual / piece.area, one.component, std::move(phi)});
  }
  return result;
}

}  // namespace morsel::morse
