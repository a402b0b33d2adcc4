#include "morsel/morse/operators/normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

using core::Index;
using core::Point;
using core::TriangleMesh;

std::vector<double> outward_signs(const TriangleMesh& mesh) {
  const Index components = mesh.component_count();
  std::vector<double> sign(components, 1.0);
  std::vector<Index> origin(components, core::kNone);
  for (Index v = mesh.vertex_count(); v-- > 0;) origin[mesh.component_of_vertex(v)] = v;
  // A power of two changes no digit, and keeps the products of three lengths in range.
  const core::BoundingBox& box = mesh.bounding_box();
  const double scale = std::ldexp(1.0, -std::ilogb(std::max((box.max - box.min).maxCoeff(), 1e-300)));
  std::vector<double> volume(components, 0.0);
  std::vector<double> magnitude(components, 0.0);
  for (const core::Triangle& t : mesh.triangles()) {
    const Index c = mesh.component_of_vertex(t[0]);
    const Point& o = mesh.position(origin[c]);
    const Point a = (mesh.position(t[0]) - o) * scale;
    const Point b = (mesh.position(t[1]) - o) * scale;
    const Point d = (mesh.position(t[2]) - o) * scale;
    const double term = a.dot(b.cross(d));
    volume[c] += term;
    magnitude[c] += std::abs(term);
  }
  // A surface whose volume is rounding alone (flat or folded) has no inside.
  for (Index c = 0; c < components; ++c)
    if (mesh.boundary_loop_count(c) == 0 && volume[c] < -1e-12 * magnitude[c]) sign[c] = -1.0;
  return sign;
}

std::vector<Point> vertex_normals(const TriangleMesh& mesh) {
  const std::vector<double> sign = outward_signs(mesh);
  std::vector<Point> normals(mesh.vertex_count());
  core::parallel_for_each(normals.size(), [&](std::size_t i) {
    const auto v = static_cast<Index>(i);
    const Point& p = mesh.position(v);
    Point sum = Point::Zero();
    mesh.for_each_outgoing(v, [&](Index h) {
      sum += (mesh.position(mesh.target(h)) - p).cross(mesh.position(mesh.apex(h)) - p);
    });
    const double length = sum.norm();
    normals[i] = length > 0 ? Point(sum * (sign[mesh.component_of_vertex(v)] / length)) : Point::Zero();
  });
  return normals;
}

}  // namespace morsel::morse
