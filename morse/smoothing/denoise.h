#pragma once
/// Smoothing of the surface itself, on which the Morse function is then evaluated again.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {

struct BilateralDenoising {
  std::optional<core::Length> sigma_c;  ///< σ_c, above 0; none: the surface's mean edge length
  std::optional<core::Length> sigma_s;  ///< σ_s, above 0; none: see SurfaceSmoothing
};

struct LaplacianDenoising {
  double lambda = 0.5;  ///< how far towards the mean of the neighbours, in (0, 1]
  EdgeWeights weights = EdgeWeights::uniform;
};

/// Moves the vertices of a surface, iteration by iteration, all at once. Triangles stay.
///
/// Bilateral (Fleishman, Drori, Cohen-Or, "Bilateral mesh denoising", 2003): v moves along its area-weighted
/// normal n by
///
///   Σ_x W_c W_s h / Σ_x W_c W_s, h = n · (x − v), W_c = exp(−‖x − v‖² / 2σ_c²), W_s = exp(−h² / 2σ_s²)
///
/// over the vertices x within 2σ_c of v that edges connect to it there (ConnectedBalls). The paper has the
/// user point at a smooth part, whose standard deviation of h becomes σ_s; here that is the median over all
/// vertices of the standard deviation of h in their balls, so that features, being few, do not count. Both
/// are determined once, from the first surface. Boundary vertices move like all others. Where σ_s is 0
/// nothing moves. It evens out noise of the size of σ_s. But how far a vertex moves depends slightly on the
/// sampling of its ball, and so do one-ring curvatures of the result: on clean, unevenly sampled meshes they
/// may have more critical points than before.
///
/// The mean edge does not determine the size of neighbourhoods where few long edges meet many short ones, as
/// at a vertex of very large degree: balls of the default σ_c could hold all vertices each. So with the
/// default, and where the balls of the first surface hold more than kMostInBall vertices on average, a ball's
/// radius is at most the distance to the kMostInBall-th nearest vertex (its centre counts). A σ_c that is
/// given is taken as it is.
///
/// Laplacian: v ← v + λ (Σ w x / Σ w − v) over the neighbours, with edge_weights() of the current surface. It
/// shrinks closed surfaces; boundary vertices stay, or boundaries would shrink to points. A vertex whose
/// weights do not sum to more than 0 stays too (cotangents may be negative, and then steps may grow instead
/// of converge; clamped and uniform ones never do).
///
/// Not thread-safe; O(n · vertices in a ball), O(n log n) with the default σ_c, or O(n) a step, parallel, the
/// same bits for every number of threads.
class SurfaceSmoothing {
 public:
  static constexpr std::size_t kMostInBall = 256;

  /// Throws InvalidArgument on options out of range, BadInput if σ_c is 0 on the mesh.
  SurfaceSmoothing(core::TriangleMesh mesh, const BilateralDenoising& options,
                   const core::Progress& progress = {});
  SurfaceSmoothing(core::TriangleMesh mesh, const LaplacianDenoising& options);

  /// One iteration. Throws BadInput if a position overflows.
  void step(const core::Progress& progress);

  const core::TriangleMesh& surface() const { return surface_; }
  double sigma_c() const { return sigma_c_; }  ///< 0 for Laplacian smoothing, as is the next
  double sigma_s() const { return sigma_s_; }
  bool limits_balls() const { return limits_balls_; }  ///< to kMostInBall vertices

 private:
  std::vector<core::Point> bilateral_positions(const core::Progress& progress) const;
  std::vector<core::Point> laplacian_positions() const;

  core::TriangleMesh surface_;
  std::optional<LaplacianDenoising> laplacian_;
  double sigma_c_ = 0;
  double sigma_s_ = 0;
  bool limits_balls_ = false;
};

/// Keys: those of StopCriteria (5 iterations), kind=bilateral|laplacian; for the first sigma-c=edge|LENGTH,
/// sigma-s=auto|LENGTH, for the other lambda, weights=uniform|clamped|cotangent. The field is the Morse
/// function of the smoothed surface, as a field on the original one. Needs context.morse_function, throws
/// InvalidArgument without. It ignores the values of its input, so it can only begin a chain.
std::unique_ptr<core::Method> make_denoise(core::ParameterReader& reader);

}  // namespace morsel::morse
