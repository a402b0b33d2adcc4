#include "morsel/mscomplex/quads/disc_embedding.h"

#include <Eigen/Geometry>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/stop.h"

namespace morsel::mscomplex {

using core::Index;
using core::Point;
using Eigen::Vector2d;

namespace {

using Corners = std::array<Point, 3>;

/// Rounds without less stretch after which no more are tried.
constexpr int kMostInVain = 3;

/// tan of half the angle at corner i of a triangle: its share in the mean-value weights of the two edges
/// there. Slivers have angles of nearly π, whose tangents would drown all other weights.
double half_tangent(const Corners& p, int i) {
  const Point u = p[(i + 1) % 3] - p[i];
  const Point v = p[(i + 2) % 3] - p[i];
  return std::clamp(std::tan(std::atan2(u.cross(v).norm(), u.dot(v)) / 2), 1e-3, 1e3);
}

/// Equations with more unknowns than this are ordered for by themselves. What COLAMD orders by, the products
/// of columns, they fill: the factors of a disc with such an equation would have its square of entries.
constexpr std::size_t kManyUnknowns = 256;

/// Renumbers rows and columns alike, which suits equations that are each about an unknown of their own.
struct MinimumDegree {
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  template <class Matrix>
  void operator()(const Matrix& matrix, PermutationType& place) const {
    PermutationType order;
    Eigen::AMDOrdering<int>()(matrix, order);
    place = order.inverse();
  }
};

/// The linear systems of one disc: each inner vertex is a weighted mean of its neighbours.
class Means {
 public:
  Means(const LayoutMesh& mesh, const Disc& disc) : mesh_(mesh), disc_(disc) {
    weights_.reserve(6 * disc.triangles.size());
    for (std::size_t k = 0; k < disc.triangles.size(); ++k) {
      const Corners p = corners(k);
      const double size = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
      for (int i = 0; i < 3; ++i) {
        if (disc.corner[3 * k + i] < disc.border_size()) continue;
        const double tangent = half_tangent(p, i);
        for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
          const double length = std::max((p[j] - p[i]).norm(), 1e-6 * size);
          weights_.push_back(
              {disc.corner[3 * k + i], disc.corner[3 * k + j], length > 0 ? tangent / length : 1});
        }
      }
    }
  }

  /// Places the inner vertices; returns whether that was possible.
  bool solve(std::vector<Vector2d>& place) {
    const Index border = disc_.border_size();
    const Index inside = disc_.vertex_count() - border;
    std::vector<double> sum(disc_.vertex_count(), 0.0);
    for (const Weight& w : weights_) sum[w.row] += w.value;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(weights_.size() + inside);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inside, 2);
    for (const Weight& w : weights_) {  // two edges between the same vertices add up
      const double share = w.value / sum[w.row];
      const Index row = w.row - border;
      if (w.column < border)
        right.row(row) += share * place[w.column].transpose();
      else
        entries.emplace_back(static_cast<int>(row), static_cast<int>(w.column - border), -share);
    }
    for (Index i = 0; i < inside; ++i) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    Matrix matrix(inside, inside);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!analysed_) {
      std::vector<std::size_t> unknowns(disc_.vertex_count(), 0);
      for (const Weight& w : weights_) ++unknowns[w.row];
      // Each equation has its own unknown's weight as the largest, at least as large as all others together.
      if (*std::max_element(unknowns.begin(), unknowns.end()) > 2 * kManyUnknowns)
        solver_.emplace<Eigen::SparseLU<Matrix, MinimumDegree>>().setPivotThreshold(0);
    }
    return std::visit(
        [&](auto& solver) {
          core::throw_if_stopped();
          if (!analysed_) solver.analyzePattern(matrix);
          analysed_ = true;
          core::throw_if_stopped();
          solver.factorize(matrix);
          core::throw_if_stopped();
          if (solver.info() != Eigen::Success) return false;
          const Eigen::MatrixX2d solution = solver.solve(right);
          if (solver.info() != Eigen::Success || !solution.allFinite()) return false;
          for (Index i = 0; i < inside; ++i) place[border + i] = solution.row(i).transpose();
          return true;
        },
        solver_);
  }

  /// Divides the weights of the edges to each vertex by the stretch there, and returns that of the whole: the
  /// integral over the surface of the mean of the squares of the singular values of the map from the plane.
  double weaken_stretched(const std::vector<Vector2d>& place) {
    std::vector<double> stretch(disc_.vertex_count(), 0.0);
    std::vector<double> area(disc_.vertex_count(), 0.0);
    double total = 0;
    for (std::size_t k = 0; k < disc_.triangles.size(); ++k) {
      const Corners p = corners(k);
      const std::array<Index, 3> at = {disc_.corner[3 * k], disc_.corner[3 * k + 1], disc_.corner[3 * k + 2]};
      const Vector2d u = place[at[1]] - place[at[0]];
      const Vector2d v = place[at[2]] - place[at[0]];
      const double plane = std::max(std::abs(u.x() * v.y() - u.y() * v.x()), 1e-30);
      const Point along_x = ((p[1] - p[0]) * v.y() - (p[2] - p[0]) * u.y()) / plane;
      const Point along_y = ((p[2] - p[0]) * u.x() - (p[1] - p[0]) * v.x()) / plane;
      const double square = (along_x.squaredNorm() + along_y.squaredNorm()) / 2;
      const double size = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
      total += size * square;
      for (const Index i : at) {
        stretch[i] += size * square;
        area[i] += size;
      }
    }
    for (Weight& w : weights_)
      if (area[w.column] > 0 && stretch[w.column] > 0)
        w.value /= std::sqrt(stretch[w.column] / area[w.column]);
    return total;
  }

 private:
  struct Weight {
    Index row, column;  // disc vertices
    double value;
  };
  Corners corners(std::size_t k) const {
    const Index h = 3 * disc_.triangles[k];
    return {mesh_.position(mesh_.origin(h)), mesh_.position(mesh_.origin(h + 1)),
            mesh_.position(mesh_.origin(h + 2))};
  }

  const LayoutMesh& mesh_;
  const Disc& disc_;
  std::vector<Weight> weights_;
  using Matrix = Eigen::SparseMatrix<double>;
  std::variant<Eigen::SparseLU<Matrix>, Eigen::SparseLU<Matrix, MinimumDegree>> solver_;
  bool analysed_ = false;
};

}  // namespace

void embed_inside(const LayoutMesh& mesh, const Disc& disc, int rounds, std::vector<Vector2d>& place,
                  const std::string& what) {
  if (disc.vertex_count() == disc.border_size()) return;
  Means means(mesh, disc);
  if (!means.solve(place))
    throw core::BadInput(
        "the region of " + what + " (" + std::to_string(disc.triangles.size()) +
        " triangles) cannot be laid out in the plane: its linear system is singular in double "
        "precision; a mesh without degenerate triangles would help");
  std::vector<Vector2d> next = place;
  double stretch = means.weaken_stretched(place);
  int in_vain = 0;
  for (int round = 0; round < rounds && in_vain < kMostInVain && means.solve(next); ++round) {
    const double now = means.weaken_stretched(next);
    if (now < stretch) {
      stretch = now;
      place = next;
      in_vain = 0;
    } else {
      ++in_vain;
    }
  }
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
