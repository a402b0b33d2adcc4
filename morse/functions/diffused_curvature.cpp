#include "morsel/morse/functions/diffused_curvature.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/operators/cholesky.h"
#include "morsel/morse/operators/intrinsic_triangles.h"
#include "morsel/morse/operators/normals.h"
#include "morsel/morse/operators/unit_size.h"

namespace morsel::morse {
namespace {

using core::Index;
using core::Point;
using core::TriangleMesh;

constexpr double kFieldPart = 3;  // the field is diffused at the scale divided by this

/// The surface's own Laplacian, M⁻¹L. Lengths are in multiples of `unit`.
struct SurfaceLaplacian {
  double unit;
  SparseMatrix weights;       // L
  std::vector<double> areas;  // M

  /// Δ f.
  std::vector<double> of(const std::vector<double>& f) const {
    using Vector = Eigen::VectorXd;
    const auto n = static_cast<Eigen::Index>(f.size());
    std::vector<double> result(f.size());
    Eigen::Map<Vector>(result.data(), n) = weights * Eigen::Map<const Vector>(f.data(), n);
    for (std::size_t v = 0; v < f.size(); ++v) result[v] /= areas[v];
    return result;
  }
};

SurfaceLaplacian laplacian_of(const TriangleMesh& mesh) {
  const EdgeLengths lengths = edge_lengths(mesh);
  const IntrinsicTriangles triangles = delaunay_triangles(mesh, lengths);
  return {lengths.unit, laplacian(triangles, mesh.vertex_count()),
          barycentric_areas(triangles, mesh.vertex_count())};
}

/// G at a scale in the Laplacian's unit.
class Diffusion {
 public:
  Diffusion(const SurfaceLaplacian& laplacian, double scale, const core::Progress& progress)
      : areas_(laplacian.areas), heat_(matrix(laplacian, scale), "mean curvature", progress) {}

  std::vector<double> of(std::vector<double> f) const {
    for (int step = 0; step < 2; ++step) {
      for (std::size_t v = 0; v < f.size(); ++v) f[v] *= areas_[v];
      f = heat_.solve(f);
    }
    return f;
  }

 private:
  static SparseMatrix matrix(const SurfaceLaplacian& laplacian, double scale) {
    SparseMatrix result = (std::sqrt(2.0) - 1) * scale * scale * laplacian.weights;
    for (std::size_t v = 0; v < laplacian.areas.size(); ++v)
      result.coeffRef(static_cast<int>(v), static_cast<int>(v)) += laplacian.areas[v];
    return result;
  }

  const std::vector<double>& areas_;
  Cholesky heat_;
};

}  // namespace

core::ScalarField diffused_mean_curvature(const TriangleMesh& mesh, double scale,
                                          const core::Progress& progress) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw core::InvalidArgument("the scale of a diffused curvature must be finite and above 0, not " +
                                core::shortest(scale));
  progress.update("mean curvature", 0);
  const UnitSized sized = unit_sized(mesh);
  const core::BoundingBox& box = sized.mesh.bounding_box();
  const Point center = (box.min + box.max) / 2;
  const SurfaceLaplacian laplacian = laplacian_of(sized.mesh);
  const double own_scale = std::ldexp(scale, -sized.exponent) / laplacian.unit;
  const std::size_t n = mesh.vertex_count();
  std::vector<Point> positions(n);
  std::array<std::vector<double>, 3> bends;  // Δ x'
  {
    const Diffusion diffusion(laplacian, own_scale, progress);
    for (int axis = 0; axis < 3; ++axis) {
      progress.throw_if_cancelled();
      std::vector<double> x(n);
      for (std::size_t v = 0; v < n; ++v)
        x[v] = (sized.mesh.position(static_cast<Index>(v)) - center)[axis] / laplacian.unit;
      x = diffusion.of(std::move(x));
      for (std::size_t v = 0; v < n; ++v) positions[v][axis] = x[v];
      bends[axis] = laplacian.of(x);
    }
  }
  const std::vector<Point> normals = vertex_normals(sized.mesh.with_positions(std::move(positions)));
  std::vector<double> curvature(n);
  core::parallel_for_each(n, [&](std::size_t v) {
    curvature[v] = Point(bends[0][v], bends[1][v], bends[2][v]).dot(normals[v]) / 2;
  });
  progress.throw_if_cancelled();
  curvature = Diffusion(laplacian, own_scale / kFieldPart, progress).of(std::move(curvature));
  core::parallel_for_each(
      n, [&](std::size_t v) { curvature[v] = std::ldexp(curvature[v] / laplacian.unit, -sized.exponent); });
  progress.update("mean curvature", 1);
  return {mesh, std::move(curvature)};
}

}  // namespace morsel::morse
