#pragma once
/// Gaussian averages of a scalar field.

#include <memory>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/salient.h"

namespace morsel::morse {

/// The options of salient() that apply without a weight of values.
struct GaussianOptions {
  int iterations = 1;
  core::Length sigma = core::Length::epsilons(8);  ///< σ, above 0
  double support = 2;                              ///< the neighbourhood's radius in σ, above 0
  NeighborWeights weights = NeighborWeights::none;
  Ball ball = Ball::euclidean;
};

/// G(f, σ)(v) = Σ_x f(x) W_c / Σ_x W_c over the vertices x with ‖x − v‖ ≤ support · σ, W_c = exp(−‖x − v‖² /
/// 2σ²): the paper's equation (1), for all v at once, `iterations` times. Computed as f + S of salient
/// smoothing whose weight of values is 1, by the same sums; cost, order of ties and errors are those of
/// salient().
core::ScalarField gaussian(const core::ScalarField& input, const GaussianOptions& options = {},
                           const core::Progress& progress = {});

/// Keys: those of StopCriteria (one iteration), sigma, support, weights=none|area, ball=euclidean|connected.
std::unique_ptr<core::Method> make_gaussian(core::ParameterReader& reader);

}  // namespace morsel::morse
