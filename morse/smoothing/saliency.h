#pragma once
/// Mesh saliency.

#include <memory>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/gaussian.h"

namespace morsel::morse {

enum class Suppression : std::uint8_t {
  itti,  ///< maps with few prominent peaks count, those with many similar ones do not
  none   ///< the maps are added as they are
};

struct SaliencyOptions {
  /// σ of each map, above 0; at least one.
  std::vector<core::Length> scales = {core::Length::epsilons(2), core::Length::epsilons(3),
                                      core::Length::epsilons(4), core::Length::epsilons(5),
                                      core::Length::epsilons(6)};
  Suppression suppression = Suppression::itti;
  double support = 2;  ///< the neighbourhoods' radius in multiples of each σ, above 0
  NeighborWeights weights = NeighborWeights::none;
  Ball ball = Ball::euclidean;
};

struct SaliencyResult {
  core::ScalarField field;
  std::vector<double> scales;   ///< in the mesh's unit
  std::vector<double> factors;  ///< that each normalised map was multiplied by; 1 without suppression
};

/// The sum over the scales σ_i of |G(f, σ_i) − G(f, 2σ_i)|, each map after suppression: Lee, Varshney,
/// Jacobs, "Mesh saliency", 2005, the paper's equations (1) and (2) and step 4 of its section 2.2, of any
/// field f (there the mean curvature). G is gaussian() with one iteration.
///
/// Suppression (Itti, Koch, Niebur 1998): each map is scaled to [0, 1], so that its largest value is M = 1,
/// and multiplied by (M − m̄)², m̄ the mean of its local maxima other than the one at M, 0 if there is none.
/// The papers leave open what a local maximum of a mesh is: here a vertex higher than all its neighbours,
/// with ties in the input's order, at boundaries too. A constant map adds nothing. With suppression the
/// result has no unit, without it that of f. Equal values keep the input's order.
///
/// Time of gaussian() for each different σ_i and 2σ_i; parallel, the same bits for every number of threads.
/// Throws InvalidArgument on options out of range, and BadInput if a scale is 0 on the mesh.
SaliencyResult saliency(const core::ScalarField& input, const SaliencyOptions& options = {},
                        const core::Progress& progress = {});

/// Keys: scales=2eps/3eps/4eps/5eps/6eps, suppression=itti|none, support, weights=none|area,
/// ball=euclidean|connected.
std::unique_ptr<core::Method> make_saliency(core::ParameterReader& reader);

}  // namespace morsel::morse
