#include "morsel/core/mesh/length.h"

#include <cmath>

#include "morsel/core/parallel/parallel.h"

namespace morsel::core {

double mean_edge_length(const TriangleMesh& mesh) {
  if (mesh.edge_count() == 0) return 0;
  const BoundingBox& box = mesh.bounding_box();
  const double side = (box.max - box.min).maxCoeff();
  const int exponent = side > 0 ? std::ilogb(side) : 0;  // squares stay in range
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

double Length::on(const TriangleMesh& mesh) const {
  switch (unit) {
    case LengthUnit::epsilon:
      return value * mesh.epsilon();
    case LengthUnit::edge:
      return value * mean_edge_length(mesh);
    case LengthUnit::percent:
      return value / 100 * mesh.bounding_box().diagonal();
    default:
      return value;
  }
}

}  // namespace morsel::core
