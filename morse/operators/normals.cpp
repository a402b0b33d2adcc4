#include "morsel/morse/operators/normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morsel/core/mesh/nesting.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

using core::Index;
using core::Point;
using core::TriangleMesh;

namespace {

/// Per component: −1, 1, or 0 for a bounded one and for a volume that is rounding alone (flat or folded).
std::vector<int> volume_signs(const TriangleMesh& mesh) {
  const Index components = mesh.component_count();
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
  std::vector<int> sign(components, 0);
  for (Index c = 0; c < components; ++c)
    if (mesh.boundary_loop_count(c) == 0 && std::abs(volume[c]) > 1e-12 * magnitude[c])
      sign[c] = volume[c] < 0 ? -1 : 1;
  return sign;
}

/// Of the closed components.
struct Orientation {
  bool is_turned = false;  ///< the outermost ones are all inside out
  bool is_mixed = false;   ///< some of the outermost ones are, and others are not
};

Orientation orientation_of(const TriangleMesh& mesh, const std::vector<int>& sign) {
  if (std::ranges::count(sign, -1) == 0) return {};
  if (std::ranges::count(sign, 1) == 0) return {true, false};
  std::vector<int> shell_sign;
  std::vector<Index> shell_of(sign.size(), core::kNone);
  for (std::size_t c = 0; c < sign.size(); ++c)
    if (sign[c] != 0) {
      shell_of[c] = static_cast<Index>(shell_sign.size());
      shell_sign.push_back(sign[c]);
    }
  std::vector<Index> shell(mesh.triangle_count());
  for (Index t = 0; t < shell.size(); ++t) shell[t] = shell_of[mesh.component_of_vertex(mesh.triangle(t)[0])];
  const auto shells = static_cast<Index>(shell_sign.size());
  const core::Nesting nesting(mesh.positions(), mesh.triangles(), shell, shells);
  const auto any_outermost = [&](int wanted) {
    for (Index s = 0; s < shells; ++s)
      if (shell_sign[s] == wanted && !nesting.is_boxed(s)) return true;
    return false;
  };
  if (!any_outermost(1)) return {true, false};
  return {false, any_outermost(-1)};
}

}  // namespace

std::vector<double> outward_signs(const TriangleMesh& mesh) {
  const std::vector<int> volume = volume_signs(mesh);
  const bool turned = orientation_of(mesh, volume).is_turned;
  std::vector<double> sign(volume.size(), 1.0);
  for (std::size_t c = 0; c < sign.size(); ++c)
    if (turned && volume[c] != 0) sign[c] = -1.0;
  return sign;
}

std::vector<std::string> orientation_warnings(const TriangleMesh& mesh) {
  const Orientation found = orientation_of(mesh, volume_signs(mesh));
  if (found.is_turned) return {"the mesh's faces are inside out: normals are turned outward"};
  if (!found.is_mixed) return {};
  return {
      "some of the mesh's outermost closed components are inside out and others are not: normals are as its "
      "faces have them"};
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
