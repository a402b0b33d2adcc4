#pragma once
/// An eigenfunction of the Laplacian as a Morse function.

#include <memory>

#include "morsel/core/field/method.h"

namespace morsel::morse {

/// Dong, Bremer, Garland, Pascucci, Hart 2006, "Spectral surface quadrangulation": functions whose critical
/// points spread evenly over the surface, the more of them the higher the index. operators/eigenfunctions.h
/// says which functions there are, how they are numbered and which sign they have.
///
/// Keys: index (default 1: the smallest λ > 0). Values are φ in 1/length with φᵀ M φ = 1. On a mesh of
/// several components the function is 0 on all but one. Resolved parameters: index, eigenvalue (1/length²),
/// residual (as a share of it) and component. An index that the mesh does not have throws BadInput.
std::unique_ptr<core::MorseFunction> make_eigenfunction(core::ParameterReader& reader);

/// The largest index: the time to find k modes grows with k², and the memory with k.
inline constexpr int kMostModes = 1000;

}  // namespace morsel::morse
