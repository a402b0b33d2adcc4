#include "morsel/morse/functions/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/normals.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;

/// Σ w κ over the edges of a vertex, and the same sum with the doubled angle of each edge's direction in the
/// tangent plane: what is left of the tensor, a trace and a traceless part.
struct Tensor {
  double mean = 0;
  double cosine = 0;
  double sine = 0;
};

/// Evaluates one vertex after the other; keeps its buffers.
class VertexCurvature {
 public:
  VertexCurvature(const core::TriangleMesh& mesh, const std::vector<double>& sign)
      : mesh_(mesh), sign_(sign) {}

  /// With `directions`, the traceless part too.
  Tensor operator()(Index v, bool directions) {
    if (!load(v)) return {};
    const Point normal = weigh(mesh_.is_boundary_vertex(v));
    double total = 0;
    for (std::size_t j = 0; j < edges_.size(); ++j) total += usable(j) ? weights_[j] : 0;
    const double length = normal.norm();
    if (!(total > 0) || !(length > 0)) return {};
    const Point n = normal * (sign_[mesh_.component_of_vertex(v)] / length);
    Tensor sum;
    const auto [axis, other] = directions ? tangents(n) : std::pair<Point, Point>();
    for (std::size_t j = 0; j < edges_.size(); ++j) {
      if (!usable(j)) continue;
      const Point& d = edges_[j];
      const double bend = weights_[j] / total * (-2 * n.dot(d) / d.squaredNorm());
      sum.mean += bend;
      if (!directions) continue;
      const double x = d.dot(axis);
      const double y = d.dot(other);
      const double square = x * x + y * y;
      if (!(square >= std::numeric_limits<double>::min())) continue;
      sum.cosine += bend * ((x * x - y * y) / square);
      sum.sine += bend * (2 * x * y / square);
    }
    const auto unscaled = [&](double value) { return value * half_ * rest_; };
    return {unscaled(sum.mean), unscaled(sum.cosine), unscaled(sum.sine)};
  }

 private:
  /// The edges leaving v, in a unit near the longest; false if all have length zero.
  bool load(Index v) {
    mesh_.neighbors(v, ring_);
    edges_.resize(ring_.size());
    double longest = 0;
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      edges_[j] = mesh_.position(ring_[j]) - mesh_.position(v);
      longest = std::max(longest, edges_[j].cwiseAbs().maxCoeff());
    }
    if (!(longest > 0)) return false;
    // In two steps, as the inverse of a subnormal length is beyond the range. Powers of two change no digit.
    const int exponent = -std::ilogb(longest);
    half_ = std::ldexp(1.0, exponent / 2);
    rest_ = std::ldexp(1.0, exponent - exponent / 2);
    for (Point& d : edges_) d = d * half_ * rest_;
    return true;
  }

  /// Sets each edge's weight, the area beside it (times two); returns the sum of the triangles' area vectors.
  Point weigh(bool boundary) {
    weights_.assign(edges_.size(), 0.0);
    Point normal = Point::Zero();
    for (std::size_t j = boundary ? 1 : 0; j < edges_.size(); ++j) {
      const std::size_t before = j == 0 ? edges_.size() - 1 : j - 1;
      const Point area = edges_[before].cross(edges_[j]);
      const double size = area.norm();
      normal += area;
      weights_[before] += size;
      weights_[j] += size;
    }
    return normal;
  }

  bool usable(std::size_t j) const { return edges_[j].squaredNorm() >= std::numeric_limits<double>::min(); }

  /// Two unit vectors that span the plane across n.
  static std::pair<Point, Point> tangents(const Point& n) {
    int least = 0;
    n.cwiseAbs().minCoeff(&least);
    const Point axis = n.cross(Point::Unit(least)).normalized();
    return {axis, n.cross(axis)};
  }

  const core::TriangleMesh& mesh_;
  const std::vector<double>& sign_;
  std::vector<Index> ring_;
  std::vector<Point> edges_;
  std::vector<double> weights_;
  double half_ = 1;  // half_ * rest_ turns lengths into the scaled unit, and scaled curvatures back
  double rest_ = 1;
};

template <class Store>
void for_each_tensor(const core::TriangleMesh& mesh, bool directions, const core::Progress& progress,
                     const Store& store) {
  progress.update("curvature", 0);
  const std::vector<double> sign = outward_signs(mesh);
  core::parallel_for(0, mesh.vertex_count(), core::kGrain, [&](std::size_t first, std::size_t last) {
    progress.throw_if_cancelled();
    VertexCurvature curvature(mesh, sign);
    for (std::size_t v = first; v < last; ++v) store(v, curvature(static_cast<Index>(v), directions));
  });
  progress.update("curvature", 1);
}

}  // namespace

core::ScalarField mean_curvature(const core::TriangleMesh& mesh, const core::Progress& progress) {
  std::vector<double> values(mesh.vertex_count());
  for_each_tensor(mesh, false, progress, [&](std::size_t v, const Tensor& t) { values[v] = t.mean; });
  return {mesh, std::move(values)};
}

PrincipalCurvatures principal_curvatures(const core::TriangleMesh& mesh, const core::Progress& progress) {
  PrincipalCurvatures result;
  result.k1.resize(mesh.vertex_count());
  result.k2.resize(mesh.vertex_count());
  // The eigenvalues are (mean ± r)/2 with r = |traceless part|, so 3 m1 − m2 = mean + 2 r.
  for_each_tensor(mesh, true, progress, [&](std::size_t v, const Tensor& t) {
    const double r = std::hypot(t.cosine, t.sine);
    result.k1[v] = t.mean + 2 * r;
    result.k2[v] = t.mean - 2 * r;
  });
  return result;
}

}  // namespace morsel::morse
