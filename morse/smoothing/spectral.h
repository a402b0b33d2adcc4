#pragma once
/// The low frequencies of a field.

#include <cstddef>
#include <memory>

#include "morsel/core/field/method.h"

namespace morsel::morse {

struct SpectralResult {
  core::ScalarField field;
  double last_eigenvalue;  ///< of the highest mode, in 1/length²; a wave of that frequency is 2π/√λ long
  double kept;  ///< the share of the field's variance (weighted by area) that is left; 1 for a constant
};

/// Projects the field f on constants, one for each component, and the first `modes` other eigenfunctions φ_i
/// of the Laplacian (operators/eigenfunctions.h):
///
///   g = Σ_components mean(f) + Σ_i (φ_iᵀ M f) φ_i,
///
/// the nearest such function in the area-weighted mean of squares. Where eigenvalues are equal, as on a
/// sphere, and `modes` separates them, g depends on which of their functions come first. Equal values keep
/// f's order. Time and errors of eigenfunctions(); BadInput if the mesh has fewer eigenfunctions. The same
/// bits for every number of threads.
SpectralResult spectral(const core::ScalarField& field, std::size_t modes,
                        const core::Progress& progress = {});

/// The method "spectral". Keys: modes (default 20), the constants not counted. Details: last_eigenvalue,
/// variance_kept.
std::unique_ptr<core::Method> make_spectral(core::ParameterReader& reader);

}  // namespace morsel::morse
