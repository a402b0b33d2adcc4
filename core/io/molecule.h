#pragma once
/// The atoms of a molecule, read from a PDB or mmCIF file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"
#include "morsel/core/types.h"

namespace morsel::core {

struct Atom {
  Point position = Point::Zero();  ///< in Å
  /// Van der Waals radius in Å, by element: Bondi 1964 (H 1.20, C 1.70, N 1.55, O 1.52, P 1.80, S 1.80 …),
  /// Mantina et al. 2009 for main-group elements that he lacks and cctbx's for the rest, as gemmi tabulates
  /// them.
  double radius = 0;
  std::string element;      ///< "C", "Ca"
  std::string name;         ///< "CA", of the atom in its residue
  std::string residue;      ///< "GLY"
  std::string chain;        ///< the author's (auth_asym_id), as in the PDB file; may be empty there
  std::string sequence_id;  ///< of the residue in its chain, with the insertion code: "52", "52A"
  std::int64_t serial = 0;  ///< the atom's number in the file
  double occupancy = 1;
  char alternate = 0;    ///< letter of the alternate location, 0 if there is only one
  bool hetero = false;   ///< a HETATM record
  bool polymer = false;  ///< of an amino acid or nucleotide, modified ones (MSE, …) included
  bool water = false;    ///< HOH, WAT, H2O, DOD

  /// "atom 12 (CA of GLY 5, chain A)".
  std::string described() const;
};

/// Which atoms of HETATM records to take (waters are another option).
enum class HeteroAtoms {
  none,
  residues,  ///< those of modified amino acids and nucleotides that gemmi knows; no ligands, no ions
  all
};

/// What to take from a file. The defaults are what a molecular surface is usually made from: the chains of
/// the first model without ligands, ions and waters.
struct MoleculeOptions {
  HeteroAtoms hetero = HeteroAtoms::residues;
  bool waters = false;
  bool hydrogens = true;  ///< those in the file; none is added
  /// Of alternate locations, residue by residue: "highest", the letter whose atoms have the largest mean
  /// occupancy (of equal ones, the first in the file); "first", the first letter in the file; "all"; or one
  /// letter. Atoms with a single location are always taken.
  std::string alternate = "highest";
  std::vector<std::string> chains;  ///< by name; empty: all
  std::int64_t model = 1;           ///< which one of the file, counted from 1
};

/// How many atoms of the model were not taken, each counted where it first applies, in this order.
struct AtomsLeftOut {
  std::size_t other_chains = 0;
  std::size_t waters = 0;
  std::size_t hetero = 0;
  std::size_t hydrogens = 0;
  std::size_t alternates = 0;

  std::size_t total() const { return other_chains + waters + hetero + hydrogens + alternates; }
  /// "106 of waters, 17 hetero"; empty if none.
  std::string described() const;
};

struct Molecule {
  std::vector<Atom> atoms;  ///< at least one, in the order of the file
  std::size_t atoms_in_model = 0;
  std::int64_t models = 1;  ///< in the file
  AtomsLeftOut left_out;
};

/// Throws InvalidArgument, saying how to have them, if this library was built without molecules
/// (MORSEL_WITH_MOLECULES=OFF); `what` needs them ("atomic-density").
void require_molecules(std::string_view what);

/// Reads a .pdb or .ent, or a .cif or .mmcif file (by extension, any case; compressed ones, too), by gemmi. Of
/// an mmCIF file, the first block with atoms counts.
///
/// Throws BadInput, naming the file and, where there is one, line or row, if it is missing, unreadable,
/// damaged (a coordinate that is not a number) or of another kind; has no atoms, or none left by the options
/// (saying what they left out); has no such model or chain (listing the chains); or if an atom that is taken
/// is of no known element. Throws InvalidArgument if `model` is below 1 or `alternate` is none of the above,
/// and as require_molecules() does.
Molecule read_molecule(const std::filesystem::path& path, const MoleculeOptions& options = {},
                       const Progress& progress = {});

/// The options as keys: hetero=none|residues|all, waters=yes|no, hydrogens=yes|no, altloc=…, chains=A/B,
/// model=1.
MoleculeOptions read_molecule_options(ParameterReader& reader);

/// The same keys with their values, as read_molecule_options() takes them.
Parameters molecule_parameters(const MoleculeOptions& options);

}  // namespace morsel::core
