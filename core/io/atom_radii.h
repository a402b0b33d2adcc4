#pragma once
/// Which radii atoms have. Internal.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/atom_records.h"

namespace morsel::core {

/// Sets the radii of the atoms that are taken by `radii` (MoleculeOptions) and returns which they are. What
/// was not found is told in `warnings`. `all_atom` is the radius by element that records have already. Throws
/// BadInput for a file of radii that is damaged, and as read_molecule() for an atom of unknown element.
AtomRadii set_radii(std::span<AtomRecord> atoms, const std::string& radii, const std::string& file,
                    std::vector<std::string>& warnings);

/// In Å (Tsai, Taylor, Chothia, Gerstein 1999), for an atom of an amino acid or nucleotide by its name there;
/// 0 for all others.
double united_atom_radius(const Atom& atom);

}  // namespace morsel::core
