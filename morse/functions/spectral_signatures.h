#pragma once
/// Heat and wave kernel signatures: what a surface looks like from each of its vertices, at a scale.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::morse {

// Both are sums over the `modes` lowest eigenfunctions of the cotangent Laplacian, λ_k with φ_k
// (operators/eigenfunctions.h), or all that there are if these are fewer. They change neither when the
// surface is moved nor when it is bent without stretching; where eigenvalues are equal they do not depend on
// the basis unless `modes` ends among equal ones. Unit 1/length²: a surface s times larger has 1/s² the
// values at an s times longer `spread`, and with a share of the box's diagonal critical points do not change
// with the size. Time and memory of eigenfunctions(); they throw as it does.

struct Signature {
  core::ScalarField field;
  std::size_t modes = 0;  ///< that were summed, constants not counted
  double last = 0;        ///< of the last mode: its weight as a share of the largest
};

/// How much of the heat is left at its source after the time t = spread²/2: the heat kernel k_t(v, v) =
/// Σ_k exp(−λ_k t) φ_k(v)², each component's constant among the φ_k (Sun, Ovsjanikov, Guibas 2009, "A concise
/// and provably informative multi-scale signature based on heat diffusion"). Large at tips, at short times
/// 1/(4πt) · (1 + t K/3 + …) with the Gaussian curvature K; 1/area for long ones. `spread` is the length by
/// which heat spreads, above 0, in the mesh's unit; throws InvalidArgument otherwise. `last` says what the
/// modes left out would weigh at most.
Signature heat_kernel_signature(const core::TriangleMesh& mesh, double spread, std::size_t modes,
                                const core::Progress& progress = {});

/// The mean probability of meeting at v a quantum particle of about one energy: Σ_k φ_k(v)² w_k / Σ_k w_k,
/// w_k = exp(−(e − log λ_k)²/2σ²) (Aubry, Schlickewei, Cremers 2011, "The wave kernel signature: a quantum
/// mechanical approach to shape analysis"). The energy e is given by its place between log λ of the lowest
/// mode, 0, and of the highest, 1, and σ as a share of that distance: both without a unit, so that nothing
/// depends on the size of the surface. Throws InvalidArgument unless `energy` is in [0, 1] and `width` at
/// least kLeastWidth.
Signature wave_kernel_signature(const core::TriangleMesh& mesh, double energy, double width,
                                std::size_t modes, const core::Progress& progress = {});

inline constexpr double kLeastWidth = 1e-6;

/// Keys: time=0.1rootarea (the spread, a length), modes=100.
std::unique_ptr<core::MorseFunction> make_heat_kernel_signature(core::ParameterReader& reader);
/// Keys: energy=0.5, width=0.07 (the paper's), modes=100.
std::unique_ptr<core::MorseFunction> make_wave_kernel_signature(core::ParameterReader& reader);

}  // namespace morsel::morse
