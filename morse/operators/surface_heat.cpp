#include "morsel/morse/operators/surface_heat.h"

#include <cmath>
#include <utility>

#include "morsel/morse/operators/intrinsic_triangles.h"

namespace morsel::morse {

std::vector<double> SurfaceLaplacian::of(std::span<const double> f) const {
  using Vector = Eigen::VectorXd;
  const auto n = static_cast<Eigen::Index>(f.size());
  std::vector<double> result(f.size());
  Eigen::Map<Vector>(result.data(), n) = weights * Eigen::Map<const Vector>(f.data(), n);
  for (std::size_t v = 0; v < f.size(); ++v) result[v] /= areas[v];
  return result;
}

SurfaceLaplacian surface_laplacian(const core::TriangleMesh& mesh) {
  const EdgeLengths lengths = edge_lengths(mesh);
  const IntrinsicTriangles triangles = delaunay_triangles(mesh, lengths);
  return {lengths.unit, laplacian(triangles, mesh.vertex_count()),
          barycentric_areas(triangles, mesh.vertex_count())};
}

HeatStep::HeatStep(const SurfaceLaplacian& laplacian, double time, const char* what,
                   const core::Progress& progress)
    : areas_(laplacian.areas), heat_(heat_matrix(laplacian.weights, laplacian.areas, time), what, progress) {}

std::vector<double> HeatStep::of(std::vector<double> f) const {
  for (std::size_t v = 0; v < f.size(); ++v) f[v] *= areas_[v];
  return heat_.solve(f);
}

double halving_time(double scale) { return (std::sqrt(2.0) - 1) * scale * scale; }

}  // namespace morsel::morse
