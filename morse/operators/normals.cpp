#include "morsel/morse/operators/normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "morsel/core/mesh/nesting.h"
#include "morsel/core/parallel/parallel.h"

namespace morsel::morse {

using core::Index;
using core::Point;
using core::TriangleMesh;

namespace {

/// Positions relative to the first vertex of their component, of about unit size, so that products of three
/// lengths stay in range; the factor is a power of two, which changes no digit.
class Relative {
 public:
  explicit Relative(const TriangleMesh& mesh) : mesh_(mesh), first_(mesh.component_count(), core::kNone) {
    for (Index v = mesh.vertex_count(); v-- > 0;) first_[mesh.component_of_vertex(v)] = v;
    const core::BoundingBox& box = mesh.bounding_box();
    scale_ = std::ldexp(1.0, -std::ilogb(std::max((box.max - box.min).maxCoeff(), 1e-300)));
  }
  Point operator()(Index v) const {
    return (mesh_.position(v) - mesh_.position(first_[mesh_.component_of_vertex(v)])) * scale_;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<Index> first_;
  double scale_ = 1;
};

/// Of a component, six times the volume in it, with the sign of its orientation.
struct Volume {
  double sum = 0;
  double magnitude = 0;  ///< the sum of the terms' absolute values
};

/// Per component; of bounded ones about its first vertex, without the lids that would close it.
std::vector<Volume> volumes_of(const TriangleMesh& mesh, const Relative& at) {
  std::vector<Volume> volumes(mesh.component_count());
  for (const core::Triangle& t : mesh.triangles()) {
    Volume& volume = volumes[mesh.component_of_vertex(t[0])];
    const double term = at(t[0]).dot(at(t[1]).cross(at(t[2])));
    volume.sum += term;
    volume.magnitude += std::abs(term);
  }
  return volumes;
}

/// Per component: −1, 1, or 0 for a bounded one and for a volume that is rounding alone (flat or folded).
std::vector<int> volume_signs(const TriangleMesh& mesh) {
  const std::vector<Volume> volumes = volumes_of(mesh, Relative(mesh));
  std::vector<int> sign(volumes.size(), 0);
  for (Index c = 0; c < volumes.size(); ++c)
    if (mesh.boundary_loop_count(c) == 0 && std::abs(volumes[c].sum) > 1e-12 * volumes[c].magnitude)
      sign[c] = volumes[c].sum < 0 ? -1 : 1;
  return sign;
}

/// Of the bounded components.
struct OpenComponents {
  std::size_t inside_out = 0;
  std::size_t flat = 0;  ///< which of their sides is outside cannot be told
};

/// A bounded component's outside is told by its volume with each boundary loop closed by a fan around the
/// loop's mean, where that is at least a quarter of that of a sphere of the same area.
OpenComponents open_components(const TriangleMesh& mesh) {
  if (mesh.is_closed()) return {};
  const Relative at(mesh);
  std::vector<Volume> volumes = volumes_of(mesh, at);
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k) {
    const std::span<const Index> loop = mesh.boundary_loop(k);
    Point middle = Point::Zero();
    for (const Index h : loop) middle += at(mesh.origin(h)) / static_cast<double>(loop.size());
    for (const Index h : loop)
      volumes[mesh.component_of_loop(k)].sum += middle.dot(at(mesh.target(h)).cross(at(mesh.origin(h))));
  }
  std::vector<double> areas(volumes.size(), 0.0);
  for (const core::Triangle& t : mesh.triangles())
    areas[mesh.component_of_vertex(t[0])] += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 2;
  OpenComponents found;
  for (Index c = 0; c < volumes.size(); ++c) {
    if (mesh.boundary_loop_count(c) == 0) continue;
    const double of_sphere = areas[c] * std::sqrt(areas[c] / M_PI);  // as the sums, six times the volume
    if (!(std::abs(volumes[c].sum) >= of_sphere / 4))
      ++found.flat;
    else if (volumes[c].sum < 0)
      ++found.inside_out;
  }
  return found;
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
  std::vector<std::string> warnings;
  const Orientation closed = orientation_of(mesh, volume_signs(mesh));
  if (closed.is_turned) warnings.emplace_back("the mesh's faces are inside out: normals are turned outward");
  if (closed.is_mixed)
    warnings.emplace_back(
        "some of the mesh's outermost closed components are inside out and others are not: normals are as "
        "its faces have them");
  const auto warn = [&](std::size_t count, const char* what) {
    if (count > 0)
      warnings.push_back("components with a boundary " + std::string(what) + ": " + std::to_string(count) +
                         "; their normals are as the faces have them, and turning the faces over changes the "
                         "sign of curvature and with it the counts");
  };
  const OpenComponents open = open_components(mesh);
  warn(open.inside_out, "that seem to be inside out");
  warn(open.flat, "of which it cannot be told which side is outside");
  return warnings;
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
