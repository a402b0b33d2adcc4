#pragma once
/// Salient smoothing: the paper's iterated bilateral filter of a scalar field.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/bilateral.h"
#include "morsel/morse/smoothing/value_range.h"

namespace morsel::morse {

/// The result of one iteration.
struct SalientIteration {
  int number;                        ///< 1, 2, …
  std::span<const double> values;    ///< f after it, per vertex
  std::span<const double> saliency;  ///< the S that it added
};

/// How the sums over pairs are computed.
enum class SalientAlgorithm : std::uint8_t {
  exact,       ///< pair by pair
  near_linear  ///< cells of near vertices share their sums: see SharedSums
};

/// How much a neighbour x counts, besides W_c W_s.
enum class NeighborWeights : std::uint8_t {
  none,  ///< like every other
  area   ///< with its mixed vertex area (vertex_areas()), so that a densely sampled region does not count for
         ///< more
};
/// Which vertices within support · σ of v are its neighbours.
enum class Ball : std::uint8_t {
  euclidean,  ///< all
  connected  ///< those that edges within the ball connect to v (ConnectedBalls): no other side of a thin part
};
std::string_view to_string(NeighborWeights weights);
std::string_view to_string(Ball ball);

struct SalientOptions {
  int iterations = 10;                             ///< 0 returns the input as it is
  core::Length sigma = core::Length::epsilons(8);  ///< σ, above 0
  ValueRange range = {};                           ///< σ_s
  double support = 2;                              ///< the neighbourhood's radius in σ, above 0
  bool return_saliency = false;                    ///< return the last S instead of f
  /// Other values than these two are computed pair by pair in double precision; connected balls at several
  /// times the cost.
  NeighborWeights weights = NeighborWeights::none;
  Ball ball = Ball::euclidean;
  /// The share of the input's extent by which the result may be off, at most 1; 0 for an exact one. The
  /// near-linear algorithm runs where it is the faster one by an estimate, which depends on the input alone.
  /// Its expansions have a relative error below 5 times this in each weight; the resulting error of the
  /// values is measured at 512 vertices in each iteration, propagated through the iterations and multiplied
  /// by eight (SharedSums::error(), an estimate, no bound). If that exceeds the accuracy, or with a local
  /// range, or with an accuracy below 1e-5, the exact algorithm runs; if the accuracy is at least 1e-5, in
  /// single precision. With heavy-tailed noise errors may grow a thousandfold in ten iterations, so that an
  /// accuracy of 1e-4 may be out of reach.
  double accuracy = 0;
  /// Also where the exact algorithm is faster: for tests and measurements.
  bool always_near_linear = false;
  /// Called after each iteration, by the calling thread; the spans live as long as the call. A run of 20
  /// iterations thus gives the results of 1 … 19, too. Numbers begin at 1 again if the near-linear algorithm
  /// is abandoned. Returns false to end after this iteration.
  std::function<bool(const SalientIteration&)> on_iteration = {};
  /// Most bytes for storing neighbours between iterations; without enough of it they are searched for in
  /// every iteration, which takes longer and gives the same bits.
  std::size_t memory = std::size_t{1} << 30;
  /// The precision of weights and sums. float32 takes half the time and stays within about 2e-6 (measured) of
  /// the field's extent after 10 iterations; neighbourhoods are always decided in double precision.
  Precision precision = Precision::float64;
  /// The processor's best if not given. Only one of instruction_sets().
  std::optional<InstructionSet> instructions = {};
  std::string_view step = "salient smoothing";  ///< as progress names it
};

/// Throws InvalidArgument, naming the value, if an option is out of range, if the saliency of 0 iterations is
/// requested, and if single precision is requested with weights or balls that do not support it.
void check(const SalientOptions& options);

struct SalientResult {
  core::ScalarField field;
  double sigma;                   ///< σ in the mesh's unit
  std::optional<double> sigma_s;  ///< σ_s in the field's unit where it is fixed, that is unless local or none
  std::uint64_t pairs = 0;        ///< pairs (v, x) within reach, v itself included
  SalientAlgorithm algorithm = SalientAlgorithm::exact;
  double promised_error =
      0;  ///< of the input's extent: the accuracy if pairs were not summed in double precision
  double estimated_error =
      0;                    ///< the same, as estimated by the near-linear algorithm, even if it was abandoned
  std::string reason = {};  ///< why the exact algorithm ran though an accuracy was given
};

/// Iterates f(v) ← f(v) + S(v), for all v at once, with
///
///   S(v) = Σ_x (f(x) − f(v)) W_c W_s / Σ_x W_c W_s over the vertices x with ‖x − v‖ ≤ support · σ,
///   W_c = exp(−‖x − v‖² / 2σ²), W_s = exp(−(f(x) − f(v))² / 2σ_s²)
///
/// (the paper's equations 3 and 4 and Listing 1, with the Morse function evaluated once, not in every
/// iteration). Distances are Euclidean; neighbourhoods are decided in double precision. S is 0 where σ_s is
/// 0. With weights=area each x counts A_x times in both sums, and in the field's standard deviation; S is 0
/// where all neighbours have no area. Equal values keep the input's order. Values are scaled by the largest
/// and lengths by σ, so that nothing overflows or underflows.
///
/// O(iterations · n · neighbours), or a sum over cells and their rims in place of neighbours if `accuracy`
/// allows it; parallel, the same bits for every number of threads, and for AVX2 and AVX-512; without fused
/// multiply-adds results differ by rounding. Throws what check() throws, and BadInput if σ is 0 on a mesh
/// whose vertices all coincide.
SalientResult salient(const core::ScalarField& input, const SalientOptions& options = {},
                      const core::Progress& progress = {});

/// Keys: those of StopCriteria, sigma, range, support, classify=smoothed|saliency, precision=double|single,
/// accuracy, weights=none|area, ball=euclidean|connected; scale (0): above 0 the input is replaced by the
/// Morse function of low_pass(mesh, scale), which is reported as iteration 0; needs context.morse_function,
/// throws InvalidArgument without, and can then only begin a chain; preset=paper|robust: the defaults of keys
/// that are not given.
std::unique_ptr<core::Method> make_salient(core::ParameterReader& reader);

}  // namespace morsel::morse
