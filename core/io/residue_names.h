#pragma once
/// Names that programs of molecular dynamics give to residues. Internal.

#include <cstdint>
#include <string>
#include <string_view>

namespace morsel::core {

enum class ResidueClass : std::uint8_t { unknown, amino_acid, nucleotide, cap, water, lipid };

/// What a residue's name means in the files of CHARMM, AMBER, GROMACS and kin, where it is not a name of the
/// PDB, or means something else there. Names are in capital letters.
struct SimulationName {
  ResidueClass residue_class = ResidueClass::unknown;
  std::string_view parent = {};  ///< the residue of the PDB whose atoms it has: "HIS" of HSD
};
SimulationName find_simulation_name(const std::string& name);

/// The element of the ion that a residue is called after ("SOD", "NA+", "MG2+", "Cl-"); empty if there is
/// none. Some of these names are those of other molecules in the PDB.
std::string ion_of_simulation(const std::string& name);

/// The text in capital letters; names are in ASCII.
std::string in_capitals(std::string_view text);

}  // namespace morsel::core
