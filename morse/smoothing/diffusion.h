#pragma once
/// Laplacian smoothing: diffusion of a scalar field over the surface, with which the paper compares itself.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/cholesky.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {

/// One explicit step for all vertices at once, towards the weighted mean of the neighbours:
///
///   f_i ← f_i + λ Σ_j w_ij (f_j − f_i) / Σ_j |w_ij|
///
/// (Taubin 1995, "A signal processing approach to fair surface design", as Ni, Garland, Hart 2004 use it on
/// functions). The denominator has magnitudes, since cotangents may be negative: a step stays bounded. With
/// weights that are not negative and λ ≤ 1 no value leaves the range of its neighbours and itself. A vertex
/// whose weights are all 0 keeps its value.
class ExplicitDiffusion {
 public:
  /// 0 < lambda ≤ 1; throws InvalidArgument otherwise. O(edges), parallel.
  ExplicitDiffusion(const core::TriangleMesh& mesh, EdgeWeights weights, double lambda);
  /// The field after one step. O(edges), parallel, the same bits for every number of threads; a constant
  /// stays exactly as it is.
  std::vector<double> step(std::span<const double> values) const;

 private:
  SparseMatrix laplacian_;
  double lambda_;
};

/// One implicit (backward Euler) step of the heat equation over the time t, stable for every t (Desbrun,
/// Meyer, Schröder, Barr 1999, "Implicit fairing of irregular meshes using diffusion and curvature flow"):
///
///   (M + t L) f' = M f, with the barycentric vertex areas M and the weighted Laplacian L.
///
/// Its matrix is factorised once. ∫f (the sum of f_i M_i) is kept.
class ImplicitDiffusion {
 public:
  /// `time` is in squared units of length, above 0 and finite; throws InvalidArgument otherwise, and BadInput
  /// if a mesh with degenerate triangles has no solution. With uniform weights the unit of time is that of M:
  /// squared length too.
  ImplicitDiffusion(const core::TriangleMesh& mesh, EdgeWeights weights, double time,
                    const core::Progress& progress = {});
  /// The field after the time t. O(n log n); a constant stays exactly as it is.
  std::vector<double> step(std::span<const double> values) const;

 private:
  SparseMatrix laplacian_;
  double time_;
  Cholesky system_;
};

/// The method "laplacian". Keys: those of StopCriteria (10 iterations), scheme=explicit|implicit,
/// weights=uniform|cotangent|clamped, lambda (explicit) and time (implicit: of one iteration, given as the
/// length ℓ by which heat spreads in it, ℓ² = 2 t being the variance of the heat kernel).
std::unique_ptr<core::Method> make_laplacian(core::ParameterReader& reader);

}  // namespace morsel::morse
