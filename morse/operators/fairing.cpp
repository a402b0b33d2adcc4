#include "morsel/morse/operators/fairing.h"

#include <array>
#include <cmath>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Point;
using core::TriangleMesh;

constexpr std::array kShares = {0.5, 1.0};  // of the scale, round by round

void check_fairing(const TriangleMesh& mesh, double scale) {
  if (!(scale >= 0) || !std::isfinite(scale))
    throw core::InvalidArgument("the scale of fairing must be finite and at least 0, not " +
                                core::shortest(scale));
  const double diagonal = mesh.bounding_box().diagonal();
  if (scale > diagonal)
    throw core::BadInput("a surface cannot be faired at a scale of " + core::shortest(scale) +
                         ", more than the diagonal of its bounding box, " + core::shortest(diagonal) +
                         ": nothing would be left of it");
}

/// Positions about the middle of the box.
std::vector<Point> centred(const TriangleMesh& mesh) {
  const core::BoundingBox& box = mesh.bounding_box();
  const Point middle = (box.min + box.max) / 2;
  std::vector<Point> positions;
  positions.reserve(mesh.vertex_count());
  for (const Point& position : mesh.positions()) positions.emplace_back(position - middle);
  return positions;
}

/// G (2 − G) x.
std::vector<Point> twice_diffused(const std::vector<Point>& x, const HeatStep& step,
                                  const core::Progress& progress) {
  std::vector<Point> result = diffused(x, step, progress);
  std::vector<Point> taken(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) taken[v] = x[v] - result[v];
  taken = diffused(std::move(taken), step, progress);
  for (std::size_t v = 0; v < x.size(); ++v) result[v] += taken[v];
  return result;
}

}  // namespace

std::vector<Point> diffused(std::vector<Point> positions, const HeatStep& step,
                            const core::Progress& progress) {
  for (int axis = 0; axis < 3; ++axis) {
    progress.throw_if_cancelled();
    std::vector<double> x(positions.size());
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = positions[v][axis];
    x = step.of(step.of(std::move(x)));
    for (std::size_t v = 0; v < x.size(); ++v) positions[v][axis] = x[v];
  }
  return positions;
}

TriangleMesh faired(const TriangleMesh& mesh, double scale, const core::Progress& progress) {
  check_fairing(mesh, scale);
  if (!(scale > 0)) return mesh;
  const UnitSized sized = unit_sized(mesh);
  const std::vector<Point> x = centred(sized.mesh);
  TriangleMesh surface = sized.mesh;
  for (const double share : kShares) {
    progress.update("surface", share - kShares.front());
    const SurfaceLaplacian laplacian = surface_laplacian(surface);
    const double own = share * std::ldexp(scale, -sized.exponent) / laplacian.unit;
    const HeatStep step(laplacian, (std::sqrt(2 + std::sqrt(2.0)) - 1) * own * own, "surface", progress);
    surface = mesh.with_positions(twice_diffused(x, step, progress));
  }
  const core::BoundingBox& box = sized.mesh.bounding_box();
  const Point middle = (box.min + box.max) / 2;
  std::vector<Point> positions(mesh.vertex_count());
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      positions[v][axis] =
          std::ldexp(surface.position(static_cast<core::Index>(v))[axis] + middle[axis], sized.exponent);
  progress.update("surface", 1);
  return mesh.with_positions(std::move(positions));
}

}  // namespace morsel::morse
