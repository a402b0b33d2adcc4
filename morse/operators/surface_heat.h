#pragma once
/// Heat on a surface, whatever its triangulation.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/cholesky.h"

namespace morsel::morse {

/// The surface's own Laplacian Δ = M⁻¹L, positive semi-definite: the cotangents L and the barycentric areas M
/// of the intrinsic Delaunay triangulation (intrinsic_triangles.h), in units of `unit`, a power of two.
struct SurfaceLaplacian {
  double unit;
  SparseMatrix weights;       // L
  std::vector<double> areas;  // M

  /// Δ f. O(n).
  std::vector<double> of(std::span<const double> f) const;
};

/// Degenerate triangles are allowed (edge_lengths.h); throws BadInput if all vertices coincide. About O(n),
/// serial.
SurfaceLaplacian surface_laplacian(const core::TriangleMesh& mesh);

/// One implicit step (1 + t Δ)⁻¹ of the heat equation; t is in the Laplacian's squared unit. Refers to the
/// Laplacian, which must outlive it.
class HeatStep {
 public:
  /// Factorises, about n^1.5; throws as Cholesky, naming `what` is computed.
  HeatStep(const SurfaceLaplacian& laplacian, double time, const char* what, const core::Progress& progress);

  /// Of a function. O(n log n).
  std::vector<double> of(std::vector<double> f) const;
  /// Of a density that is given by its integral at each vertex, M f. O(n log n).
  std::vector<double> of_integrals(std::span<const double> integrals) const { return heat_.solve(integrals); }

 private:
  const std::vector<double>& areas_;
  Cholesky heat_;
};

/// The time of each of two steps that halve a wave of length 2πs: G(s) = (1 + t Δ)⁻² with t = (√2 − 1) s².
double halving_time(double scale);

}  // namespace morsel::morse
