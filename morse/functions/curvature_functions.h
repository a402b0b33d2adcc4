#pragma once
/// Curvatures as Morse functions that are chosen by name.

#include <memory>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/morse/functions/curvature.h"

namespace morsel::morse {

/// √((k1² + k2²)/2), unit 1/length (Koenderink, van Doorn, "Surface shape and scales", 1992). O(n).
std::vector<double> curvedness(const PrincipalCurvatures& curvatures);

/// (2/π) atan((k1 + k2)/(k1 − k2)), in [−1, 1] and without unit (the same paper, whose sign is that of inward
/// normals): 1 for a cap as on a sphere, ½ for a ridge, 0 for a symmetric saddle, −½ for a rut, −1 for a cup;
/// 0 where both curvatures are 0, where the paper leaves it undefined. O(n).
std::vector<double> shape_index(const PrincipalCurvatures& curvatures);

// All have the key scale=8eps, scale=1.5edges or scale=0.25 (default 0): then they are those of
// low_pass(mesh, scale), as fields on the mesh, and the resolved parameters hold the scale.
//
// Where a key estimator=quadric is named, radius=8eps or radius=0.25 is the radius of the fitted quadrics
// (quadric_curvatures(); default 0.015rootarea); only quadrics have it. The resolved parameters then also
// hold how many vertices took rings in place of too small a ball (widened_vertices), and how many could not
// be fitted (unfitted_vertices).
//
// With estimator=diffused the scale of mean-curvature is 0.6edges unless given, and diffusion (0.036rootarea)
// is the scale of diffused_mean_curvature(); gaussian-curvature then is diffused_gaussian_curvature() with
// the lengths fairing (0.8%) and spread (20%).

/// Keys: estimator=taubin|cotangent|diffused|quadric, scale, radius, diffusion.
std::unique_ptr<core::MorseFunction> make_mean_curvature(core::ParameterReader& reader);
/// Keys: estimator=defect|diffused|quadric, scale, radius, fairing, spread.
std::unique_ptr<core::MorseFunction> make_gaussian_curvature(core::ParameterReader& reader);
/// Keys: which=max|min, estimator=taubin|quadric, scale, radius.
std::unique_ptr<core::MorseFunction> make_principal_curvature(core::ParameterReader& reader);
/// Keys: estimator=taubin|quadric, scale, radius.
std::unique_ptr<core::MorseFunction> make_curvedness(core::ParameterReader& reader);
/// Keys: estimator=taubin|quadric, scale, radius.
std::unique_ptr<core::MorseFunction> make_shape_index(core::ParameterReader& reader);

}  // namespace morsel::morse
