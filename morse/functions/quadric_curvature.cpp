#include "morsel/morse/functions/quadric_curvature.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/operators/connected_ball.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;

constexpr double kLeastPivot = 1e-8;  // over the largest

/// A quadric as seen from a vertex.
struct Quadric {
  double a, b, c, d, e;
};

/// Least squares over points (x, y, z) that are relative to the vertex; none if they do not fix the quadric.
std::optional<Quadric> fit(std::span<const Point> points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max(largest, std::hypot(p.x(), p.y()));
  if (!(largest > 0)) return std::nullopt;
  // Monomials f, x, y, x², xy, y² in a unit in which they are at most 1.
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();
  for (const Point& p : points) {
    const double x = p.x() / largest;
    const double y = p.y() / largest;
    const double row[6] = {1, x, y, x * x, x * y, y * y};
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) normal(i, j) += row[i] * row[j];
      right[i] += row[i] * p.z();
    }
  }
  const Eigen::LDLT<Matrix, Eigen::Lower> factor(normal);
  const Vector pivots = factor.vectorD();
  if (!(pivots.minCoeff() > kLeastPivot * pivots.maxCoeff())) return std::nullopt;
  const Vector solution = factor.solve(right);
  const double square = largest * largest;
  return Quadric{solution[3] / square, solution[4] / square, solution[5] / square, solution[1] / largest,
                 solution[2] / largest};
}

/// Of the graph of the quadric at the origin, positive where it bends away from z: the eigenvalues of L⁻¹ II
/// L⁻ᵀ with I = L Lᵀ, the first and second fundamental forms.
std::pair<double, double> curvatures(const Quadric& q) {
  const double stretch = std::sqrt(1 + q.d * q.d + q.e * q.e);
  const double l11 = std::sqrt(1 + q.d * q.d);
  const double l21 = q.d * q.e / l11;
  const double l22 = stretch / l11;
  const double s11 = -2 * q.a / stretch / (l11 * l11);
  const double s12 = (-q.b / stretch / l11 - s11 * l21) / l22;
  const double s22 = ((-2 * q.c / stretch + l21 * (2 * q.b / stretch / l11 + l21 * s11)) / l22) / l22;
  const double mean = (s11 + s22) / 2;
  const double half = std::hypot((s11 - s22) / 2, s12);
  return {mean + half, mean - half};
}

}  // namespace

QuadricCurvatures quadric_curvatures(const core::TriangleMesh& mesh, double radius,
                                     const core::Progress& progress) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw core::InvalidArgument("the radius of fitted quadrics must be finite and above 0, not " +
                                core::shortest(radius));
  progress.update("curvature", 0);
  const UnitSized sized = unit_sized(mesh);
  const ConnectedBalls balls(sized.mesh);
  const double unit_radius = std::ldexp(radius, -sized.exponent);
  const std::vector<Point> normals = vertex_normals(sized.mesh);
  const std::size_t n = mesh.vertex_count();
  QuadricCurvatures result;
  PrincipalCurvatures& k = result.curvatures;
  k.k1.assign(n, 0);
  k.k2.assign(n, 0);
  std::vector<std::uint8_t> unfitted(n, 0);
  std::atomic<std::size_t> widened = 0;
  progress.update("curvature", 0.1);
  const auto run = [&](std::size_t first, std::size_t last) {
    progress.throw_if_cancelled();
    ConnectedBalls::Walk walk(balls);
    std::vector<Index> ball;
    std::vector<Point> local;
    for (std::size_t v = first; v < last; ++v) {
      const Point& z = normals[v];
      if (z.isZero(0)) {
        unfitted[v] = 1;
        continue;
      }
      walk.within(static_cast<Index>(v), unit_radius, ball);
      if (ball.size() < kLeastFitted) {
        widened.fetch_add(1, std::memory_order_relaxed);
        walk.widen(kLeastFitted, ball);
      }
      const Point x = z.unitOrthogonal();
      const Point y = z.cross(x);
      const Point& origin = sized.mesh.position(static_cast<Index>(v));
      local.clear();
      for (const Index u : ball) {
        const Point p = sized.mesh.position(u) - origin;
        local.emplace_back(p.dot(x), p.dot(y), p.dot(z));
      }
      const std::optional<Quadric> quadric = fit(local);
      unfitted[v] = quadric ? 0 : 1;
      if (!quadric) continue;
      const auto [k1, k2] = curvatures(*quadric);
      k.k1[v] = std::ldexp(k1, -sized.exponent);
      k.k2[v] = std::ldexp(k2, -sized.exponent);
    }
  };
  core::parallel_for(0, n, balls.grain(), run);
  result.widened = widened;
  result.unfitted = static_cast<std::size_t>(std::count(unfitted.begin(), unfitted.end(), 1));
  if (result.unfitted > 0) {
    const PrincipalCurvatures taubin = principal_curvatures(mesh, progress);
    for (std::size_t v = 0; v < n; ++v) {
      if (unfitted[v] == 0) continue;
      k.k1[v] = taubin.k1[v];
      k.k2[v] = taubin.k2[v];
    }
  }
  progress.update("curvature", 1);
  return result;
}

}  // namespace morsel::morse
