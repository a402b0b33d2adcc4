#include "morsel/core/mesh/length.h"

#include <Eigen/Geometry>
#include <cmath>

#include "morsel/core/parallel/parallel.h"

namespace morsel::core {

namespace {

/// Divided by two to the power of this, coordinates are of about unit size: squares stay in range.
int exponent_of(const TriangleMesh& mesh) {
  const BoundingBox& box = mesh.bounding_box();
  const double side = (box.max - box.min).maxCoeff();
  return side > 0 ? std::ilogb(side) : 0;
}

}  // namespace

double mean_edge_length(const TriangleMesh& mesh) {
  if (mesh.edge_count() == 0) return 0;
  const int exponent = exponent_of(mesh);
  const double sum = parallel_reduce(
      0, mesh.edge_count(), kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t e = first; e < last; ++e) {
          const auto [a, b] = mesh.edge_vertices(static_cast<Index>(e));
          Point d = mesh.position(a) - mesh.position(b);
          for (int axis = 0; axis < 3; ++axis) d[axis] = std::ldexp(d[axis], -exponent);
          part += d.norm();
        }
        return part;
      },
      [](double a, double b) { return a + b; });
  return std::ldexp(sum / static_cast<double>(mesh.edge_count()), exponent);
}

double root_area(const TriangleMesh& mesh) {
  const int exponent = exponent_of(mesh);
  const auto side = [&](Index from, Index to) {
    Point d = mesh.position(to) - mesh.position(from);
    for (int axis = 0; axis < 3; ++axis) d[axis] = std::ldexp(d[axis], -exponent);
    return d;
  };
  const double sum = parallel_reduce(
      0, mesh.triangle_count(), kGrain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) {
          const Triangle& t = mesh.triangle(static_cast<Index>(i));
          part += side(t[0], t[1]).cross(side(t[0], t[2])).norm() / 2;
        }
        return part;
      },
      [](double a, double b) { return a + b; });
  return std::ldexp(std::sqrt(sum), exponent);
}

double Length::on(const TriangleMesh& mesh) const {
  switch (unit) {
    case LengthUnit::epsilon:
      return value * mesh.epsilon();
    case LengthUnit::edge:
      return value * mean_edge_length(mesh);
    case LengthUnit::percent:
      return value / 100 * mesh.bounding_box().diagonal();
    case LengthUnit::root_area:
      return value * morsel::core::root_area(mesh);
    default:
      return value;
  }
}

}  // namespace morsel::core
