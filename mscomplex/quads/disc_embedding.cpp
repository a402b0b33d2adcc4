#include "morsel/mscomplex/quads/disc_embedding.h"

#include <Eigen/Geometry>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "morsel/core/error.h"

namespace morsel::mscomplex {

using core::Index;
using core::Point;
using Eigen::Vector2d;

namespace {

/// tan of half the angle at corner i of a triangle: how the mean-value weights of the two edges there begin. Slivers have
/// angles of nearly π, whose tangents would drown all other weights.
double half_tangent(const std::array<Point, 3>& p, int i) {
  const Point u = p[(i + 1) % 3] - p[i];
  const Point v = p[(i + 2) % 3] - p[i];
  const double lengths = u.norm() * v.norm();
  if (!(lengths > 0)) return 1e-3;
  const double cosine = std::clamp(u.dot(v) / lengths, -1.0, 1.0);
  const double sine = std::min(1.0, u.cross(v).norm() / lengths);
  return std::clamp(sine / (1 + cosine), 1e-3, 1e3);
}

}  // namespace

void embed_inside(const LayoutMesh& mesh, const Disc& disc, std::vector<Vector2d>& place,
                  const std::string& what) {
  const Index border = disc.border_size();
  const Index inside = disc.vertex_count() - border;
  if (inside == 0) return;

  // Two edges that the disc has of one pair of its vertices add up.
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * disc.triangles.size());
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inside, 2);
  std::vector<double> sum(inside, 0.0);
  struct Weight {
    Index row, column;
    double value;
  };
  std::vector<Weight> weights;
  weights.reserve(6 * disc.triangles.size());
  for (std::size_t k = 0; k < disc.triangles.size(); ++k) {
    const Index h = 3 * disc.triangles[k];
    const std::array<Point, 3> p = {mesh.position(mesh.origin(h)), mesh.position(mesh.origin(h + 1)),
                                    mesh.position(mesh.origin(h + 2))};
    const double size = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    for (int i = 0; i < 3; ++i) {
      const Index row = disc.corner[3 * k + i];
      if (row < border) continue;
      const double tangent = half_tangent(p, i);
      for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
        const double length = std::max((p[j] - p[i]).norm(), 1e-6 * size);
        const double weight = length > 0 ? tangent / length : 1;
        weights.push_back({row - border, disc.corner[3 * k + j], weight});
        sum[row - border] += weight;
      }
    }
  }
  for (const Weight& w : weights) {
    const double share = w.value / sum[w.row];
    if (w.column < border)
      right.row(w.row) += share * place[w.column].transpose();
    else
      entries.emplace_back(static_cast<int>(w.row), static_cast<int>(w.column - border), -share);
  }
  for (Index i = 0; i < inside; ++i) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
  Eigen::SparseMatrix<double> matrix(inside, inside);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver;
  solver.isSymmetric(true);  // in its pattern
  solver.compute(matrix);
  Eigen::MatrixX2d solution;
  if (solver.info() == Eigen::Success) solution = solver.solve(right);
  if (solver.info() != Eigen::Success || !solution.allFinite())
    throw core::BadInput(
        "the region of " + what + " (" + std::to_string(disc.triangles.size()) +
        " triangles) cannot be laid out in the plane: its linear system is singular in double "
        "precision; a mesh without degenerate triangles would help");
  for (Index i = 0; i < inside; ++i) place[border + i] = solution.row(i).transpose();
}

std::vector<double> share_along_border(const LayoutMesh& mesh, const Disc& disc, Index first, Index last,
                                       double floor) {
  const Index steps = last - first;
  std::vector<double> share(steps + 1, 0.0);
  double total = 0;
  for (Index i = 0; i < steps; ++i) {
    const Index h = disc.border[(first + i) % disc.border_size()];
    share[i + 1] = (mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h))).norm();
    total += share[i + 1];
  }
  const double least = total > 0 ? floor * total / steps : 1;
  for (Index i = 1; i <= steps; ++i) share[i] = share[i - 1] + std::max(share[i], least);
  for (double& s : share) s /= share.back();
  return share;
}

std::vector<Vector2d> border_on_circle(const LayoutMesh& mesh, const Disc& disc,
                                       const std::vector<Index>& at) {
  constexpr double kFloor = 1e-2;
  std::vector<Vector2d> place(disc.vertex_count(), Vector2d::Zero());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Index last = k + 1 < at.size() ? at[k + 1] : at.front() + disc.border_size();
    const std::vector<double> share = share_along_border(mesh, disc, at[k], last, kFloor);
    for (Index i = at[k]; i < last; ++i) {
      const double angle =
          2 * std::numbers::pi * (static_cast<double>(k) + share[i - at[k]]) / static_cast<double>(at.size());
      place[i % disc.border_size()] = {std::cos(angle), std::sin(angle)};
    }
  }
  return place;
}

}  // namespace morsel::mscomplex
