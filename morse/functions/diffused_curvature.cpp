#include "morsel/morse/functions/diffused_curvature.h"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/functions/discrete_curvature.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/surface_heat.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

constexpr double kFieldPart = 3;  // the field is diffused at the scale divided by this

/// G(scale) f, with the step of its time.
std::vector<double> diffused(const HeatStep& step, std::vector<double> f) {
  return step.of(step.of(std::move(f)));
}

/// The surface after G(scale), about its box's centre, in the Laplacian's unit.
std::vector<Point> faired(const TriangleMesh& mesh, const SurfaceLaplacian& laplacian, const HeatStep& step,
                          const core::Progress& progress) {
  const core::BoundingBox& box = mesh.bounding_box();
  const Point center = (box.min + box.max) / 2;
  std::vector<Point> positions(mesh.vertex_count());
  for (int axis = 0; axis < 3; ++axis) {
    progress.throw_if_cancelled();
    std::vector<double> x(positions.size());
    for (std::size_t v = 0; v < x.size(); ++v)
      x[v] = (mesh.position(static_cast<Index>(v)) - center)[axis] / laplacian.unit;
    x = diffused(step, std::move(x));
    for (std::size_t v = 0; v < x.size(); ++v) positions[v][axis] = x[v];
  }
  return positions;
}

std::vector<double> coordinates(std::span<const Point> points, int axis) {
  std::vector<double> x(points.size());
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = points[v][axis];
  return x;
}

void check(const char* what, double length, bool may_be_zero) {
  if ((may_be_zero && length == 0) || (length > 0 && std::isfinite(length))) return;
  throw core::InvalidArgument(std::string("the ") + what + " of a diffused curvature must be finite and " +
                              (may_be_zero ? "at least" : "above") + " 0, not " + core::shortest(length));
}

}  // namespace

core::ScalarField diffused_mean_curvature(const TriangleMesh& mesh, double scale,
                                          const core::Progress& progress) {
  check("scale", scale, false);
  progress.update("mean curvature", 0);
  const UnitSized sized = unit_sized(mesh);
  const SurfaceLaplacian laplacian = surface_laplacian(sized.mesh);
  const double own_scale = std::ldexp(scale, -sized.exponent) / laplacian.unit;
  const std::size_t n = mesh.vertex_count();
  std::vector<Point> positions = faired(
      sized.mesh, laplacian, {laplacian, halving_time(own_scale), "mean curvature", progress}, progress);
  std::array<std::vector<double>, 3> bends;  // Δ x'
  for (int axis = 0; axis < 3; ++axis) bends[axis] = laplacian.of(coordinates(positions, axis));
  const std::vector<Point> normals = vertex_normals(sized.mesh.with_positions(std::move(positions)));
  std::vector<double> curvature(n);
  core::parallel_for_each(n, [&](std::size_t v) {
    curvature[v] = Point(bends[0][v], bends[1][v], bends[2][v]).dot(normals[v]) / 2;
  });
  progress.throw_if_cancelled();
  const HeatStep step(laplacian, halving_time(own_scale / kFieldPart), "mean curvature", progress);
  curvature = diffused(step, std::move(curvature));
  core::parallel_for_each(
      n, [&](std::size_t v) { curvature[v] = std::ldexp(curvature[v] / laplacian.unit, -sized.exponent); });
  progress.update("mean curvature", 1);
  return {mesh, std::move(curvature)};
}

core::ScalarField diffused_gaussian_curvature(const TriangleMesh& mesh, double fairing, double spread,
                                              const core::Progress& progress) {
  check("fairing", fairing, true);
  check("spread", spread, false);
  progress.update("Gaussian curvature", 0);
  const UnitSized sized = unit_sized(mesh);
  const SurfaceLaplacian laplacian = surface_laplacian(sized.mesh);
  const auto own = [&](double length) { return std::ldexp(length, -sized.exponent) / laplacian.unit; };
  std::vector<double> curvature;
  if (fairing > 0) {
    const HeatStep step(laplacian, halving_time(own(fairing)), "Gaussian curvature", progress);
    curvature = angle_defects(sized.mesh.with_positions(faired(sized.mesh, laplacian, step, progress)));
  } else {
    curvature = angle_defects(sized.mesh);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_boundary_vertex(v)) curvature[v] = 0;  // there it is how the rim turns
  progress.update("Gaussian curvature", 0.5);
  const HeatStep step(laplacian, own(spread) * own(spread) / 2, "Gaussian curvature", progress);
  curvature = step.of_integrals(curvature);
  core::parallel_for_each(curvature.size(), [&](std::size_t v) {
    curvature[v] = std::ldexp(curvature[v] / laplacian.unit / laplacian.unit, -2 * sized.exponent);
  });
  progress.update("Gaussian curvature", 1);
  return {mesh, std::move(curvature)};
}

}  // namespace morsel::morse
