#pragma once
/// The sums of the bilateral filter: weighted means of differences over all balls of a radius, fast.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"
#include "morsel/morse/smoothing/instruction_set.h"

namespace morsel::morse {

/// The precision of weights and sums. Which points are neighbours is always decided in double precision.
enum class Precision : std::uint8_t { float64, float32 };

class BilateralEngine;

/// Computes, repeatedly for the same points,
///
///   S(v) = Σ_x (f(x) − f(v)) W_c W_s / Σ_x W_c W_s over the points x with ‖x − v‖ ≤ radius,
///   W_c = exp(−‖x − v‖² / 2σ²), W_s = exp(−(f(x) − f(v))² / 2σ_s²).
///
/// Points lie in small blocks along a tree. The pairs of blocks within reach are found once; most lie there
/// wholly, so that the inner loop tests no distances. It visits each pair of points once for both directions
/// and takes one exponential for both weights. Sums are computed chunk by chunk and added in the order of the
/// chunks: the same bits for any number of threads and any memory; for the instruction sets see PairKernels.
/// With connected balls the sums are computed vertex by vertex instead (ListedSums), in float64 and without a
/// tolerance, which holds for weights, too. In float64 the weights are 2e-15 from the true ones. In float32
/// coordinates and values are relative to a point within the chunk, sums over chunks are in double, and
/// chunks that are wide compared with σ are computed in float64, so S stays within about 1e-7 of the extent.
class BilateralFilter {
 public:
  struct Options {
    double radius;
    double sigma;  ///< σ
    Precision precision = Precision::float64;
    InstructionSet instructions = InstructionSet::baseline;  ///< one that the processor has
    /// Above 0: float32, and pairs of cells share work (see SharedSums) whose expansions are within this,
    /// relatively.
    double tolerance = 0;
    std::size_t memory =
        0;  ///< most bytes for keeping pairs between calls; without it they are found each time
    /// How often each point counts in both sums, ≥ 0 and of moderate size; empty: once.
    std::vector<double> weights = {};
    /// If given, a surface whose positions are the points: only those x count that its edges connect to v
    /// within the ball.
    std::optional<core::TriangleMesh> connected_by = {};
  };
  /// Called with the fraction of a call that is done, in [0, 1], by the calling thread.
  using Report = std::function<void(double fraction)>;

  /// O(n log n). Keeps nothing of `points`, but refers to `progress`, by which apply() is stopped.
  BilateralFilter(std::span<const core::Point> points, const Options& options,
                  const core::Progress& progress);
  ~BilateralFilter();
  BilateralFilter(const BilateralFilter&) = delete;
  BilateralFilter& operator=(const BilateralFilter&) = delete;

  /// S, one per point, for a fixed σ_s; or with σ_s(v) = max |f(x) − f(v)| over the ball of v where there is
  /// none. 0 where σ_s is 0. Values are of order 1. O(pairs), parallel.
  void apply(std::span<const double> values, std::optional<double> sigma_s, std::span<double> result,
             const Report& report);

  /// With a tolerance: about how many times faster that makes a call for such a field; none if it is not
  /// applicable.
  std::optional<double> gain(std::span<const double> values, double sigma_s) const;
  /// With a tolerance: the estimated error of the values, SharedSums::error(); infinite if it was not
  /// applicable in some call.
  double error() const;

  /// Pairs (v, x) that a call visits, v itself included; known after the first.
  std::uint64_t pairs() const;

 private:
  template <class Mask, class Real>
  class EngineOf;
  std::unique_ptr<BilateralEngine> engine_;
};

}  // namespace morsel::morse
