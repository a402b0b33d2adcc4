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
  std::vector<core::Length> scales = {core::Length::root_areas(0.006), core::Length::root_areas(0.009),
                                      core::Length::root_areas(0.012), core::Length::root_areas(0.015),
                                      core::Length::root_areas(0.018)};
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

/// The scales that Lee, Varshney and Jacobs used, 2ε to 6ε, which change as the mesh is turned; the default
/// has shares of the root of the area in their place, which do not.
std::vector<core::Length> published_scales();

/// Keys: scales=0.006rootarea/0.009rootarea/0.012rootarea/0.015rootarea/0.018rootarea,
/// suppression=itti|none, support, weights=none|area, ball=euclidean|connected.
std::unique_ptr<core::Method> make_saliency(core::ParameterReader& reader);

}  // namespace morsel::morse
