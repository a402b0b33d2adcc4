#pragma once
/// Density of the atoms around a molecular surface.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "morsel/core/field/method.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/molecule.h"

namespace morsel::morse {

enum class AtomWeight : std::uint8_t {
  one,
  charge  ///< Atom::charge
};

struct AtomicDensityOptions {
  double decay = 0.5;     ///< D > 0, of the Gaussians
  double cutoff = 1e-12;  ///< in (0, 1): Gaussians below this are left out
  AtomWeight weight = AtomWeight::one;
};

/// ρ(x) = Σ_i w_i exp(−D ‖x − c_i‖² / r_i²) at each vertex x: over atoms with centers c_i and radii r_i, both
/// in Å, as the mesh must be, and weights w_i of 1, or charges for a density of charge. High where the
/// surface lies in a pocket of the molecule, low on protrusions. It serves to segment molecular surfaces
/// after Natarajan, Wang, Bremer, Pascucci, Hamann 2006; the width of the Gaussians is an option, and D =
/// 1/2, which makes r_i their standard deviation, a choice made here. On a Gaussian surface whose blobbiness
/// is D the density is constant but for the mesh's errors: choose another D there.
///
/// Throws InvalidArgument if an option is out of range, there are no atoms or one has no finite position and
/// positive radius, or no charge where that is the weight; BadInput if no vertex has an atom within the
/// cut-off, as when the mesh lies in another frame or unit. O(n k log k) with k atoms within the cut-off,
/// √(−ln cutoff / D) of the largest radius; parallel, the same bits for any number of threads.
core::ScalarField atomic_density(const core::TriangleMesh& mesh, std::span<const core::Atom> atoms,
                                 const AtomicDensityOptions& options = {},
                                 const core::Progress& progress = {});

/// Keys: structure=FILE (.pdb, .ent, .cif, .mmcif, .pqr; read when the function is evaluated), decay=0.5,
/// cutoff=1e-12, weight=one|charge, and which atoms to take, with which radii: the keys of
/// core::read_molecule_options(). The resolved parameters also hold the number of atoms. What was odd in the
/// file is among the warnings.
std::unique_ptr<core::MorseFunction> make_atomic_density(core::ParameterReader& reader);

}  // namespace morsel::morse
