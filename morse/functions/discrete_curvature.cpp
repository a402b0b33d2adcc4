#include "morsel/morse/functions/discrete_curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

double corner_angle(const Point& a, const Point& b) {
  const bool no_a = a.squaredNorm() == 0;
  const bool no_b = b.squaredNorm() == 0;
  if (no_a && no_b) return M_PI / 3;
  if (no_a || no_b) return M_PI / 2;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<double> unit_angle_defects(const TriangleMesh& mesh) {
  std::vector<double> defect(mesh.vertex_count());
  core::parallel_for_each(defect.size(), [&](std::size_t i) {
    const auto v = static_cast<Index>(i);
    const Point& p = mesh.position(v);
    double sum = 0;
    mesh.for_each_outgoing(v, [&](Index h) {
      sum += corner_angle(mesh.position(mesh.target(h)) - p, mesh.position(mesh.apex(h)) - p);
    });
    defect[i] = (mesh.is_boundary_vertex(v) ? M_PI : 2 * M_PI) - sum;
  });
  return defect;
}

}  // namespace

std::vector<double> angle_defects(const TriangleMesh& mesh) {
  return unit_angle_defects(unit_sized(mesh).mesh);
}

core::ScalarField gaussian_curvature(const TriangleMesh& mesh, const core::Progress& progress) {
  progress.update("curvature", 0);
  const auto [unit, exponent] = unit_sized(mesh);
  std::vector<double> values = unit_angle_defects(unit);
  const std::vector<double> area = vertex_areas(unit, VertexArea::mixed);
  for (std::size_t v = 0; v < values.size(); ++v)
    values[v] = area[v] > 0 ? std::ldexp(values[v] / area[v], -2 * exponent) : 0;
  progress.update("curvature", 1);
  return {mesh, std::move(values)};
}

core::ScalarField cotangent_mean_curvature(const TriangleMesh& mesh, const core::Progress& progress) {
  progress.update("curvature", 0);
  if (mesh.bounding_box().diagonal() == 0) return {mesh, std::vector<double>(mesh.vertex_count(), 0.0)};
  const UnitSized sized = unit_sized(mesh);
  const TriangleMesh& unit = sized.mesh;
  const std::vector<double> weight = edge_weights(unit, EdgeWeights::cotangent);
  const std::vector<double> area = vertex_areas(unit, VertexArea::mixed);
  const std::vector<Point> normals = vertex_normals(unit);
  progress.update("curvature", 0.5);
  std::vector<double> values(area.size(), 0.0);
  core::parallel_for_each(values.size(), [&](std::size_t i) {
    if (!(area[i] > 0)) return;
    const auto v = static_cast<Index>(i);
    Point sum = Point::Zero();
    const auto add = [&](Index h, Index other) {
      sum += weight[unit.edge(h)] * (unit.position(v) - unit.position(other));
    };
    Index end = core::kNone;
    unit.for_each_outgoing(v, [&](Index h) {
      add(h, unit.target(h));
      end = TriangleMesh::previous(h);
    });
    const bool boundary = unit.is_boundary_vertex(v);
    if (boundary) add(end, unit.origin(end));
    const double along = sum.dot(normals[i]);
    const double size = boundary ? along : std::copysign(sum.norm(), along);
    values[i] = std::ldexp(size / (2 * area[i]), -sized.exponent);
  });
  progress.update("curvature", 1);
  return {mesh, std::move(values)};
}

}  // namespace morsel::morse
