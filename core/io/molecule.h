#pragma once
/// The atoms of a molecule, read from a PDB, mmCIF or PQR file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"
#include "morsel/core/types.h"

namespace morsel::core {

struct Atom {
  Point position = Point::Zero();  ///< in Å
  double radius = 0;               ///< in Å, as MoleculeOptions::radii says
  std::string element;             ///< "C", "Ca"
  std::string name;                ///< "CA", of the atom in its residue
  std::string residue;             ///< "GLY"
  std::string chain;               ///< the author's (auth_asym_id), as in the PDB file; may be empty there
  std::string sequence_id;         ///< of the residue in its chain, with the insertion code: "52", "52A"
  std::int64_t serial = 0;         ///< the atom's number in the file
  double occupancy = 1;
  char alternate = 0;                 ///< letter of the alternate location, 0 if there is only one
  std::optional<double> charge = {};  ///< in elementary charges, where the file has it (PQR)
  bool hetero = false;                ///< a HETATM record
  /// Of an amino acid or nucleotide, modified ones (MSE, …), those of simulations (HSD, CYX, …) and what the
  /// file's sequence has included, or with their backbone in ATOM records.
  bool polymer = false;
  bool water = false;     ///< HOH, WAT, H2O, DOD, TIP3, SOL, SPC, …
  bool ion = false;       ///< a single atom: CL, ZN2, SOD, CLA, NA+, …
  bool hydrogen = false;  ///< or deuterium

  /// "atom 12 (CA of GLY 5, chain A)".
  std::string described() const;
};

/// What files of molecules are read.
enum class MoleculeFormat { pdb, mmcif, pqr };
/// "pdb", "mmcif" and "pqr", as `--format` takes them.
std::vector<std::string> molecule_format_names();
/// Throws InvalidArgument on another name.
MoleculeFormat molecule_format_named(std::string_view name);

/// Which atoms of HETATM records, ions and known ligands and lipids to take (waters are another option).
enum class HeteroAtoms {
  none,
  residues,  ///< those of polymers (Atom::polymer); no ligands, no ions
  all
};

/// Which radii atoms have, in Å.
enum class AtomRadii {
  /// Van der Waals radii by element: Bondi 1964 (H 1.20, C 1.70, N 1.55, O 1.52, P 1.80, S 1.80 …), Mantina
  /// et al. 2009 for main-group elements that he lacks and cctbx's for the rest, as gemmi tabulates them.
  all_atom,
  /// For structures without hydrogens, whose room their carbons, … then take: Tsai, Taylor, Chothia, Gerstein
  /// 1999 (ProtOr) for amino acids and, by their classes, nucleotides (C 1.61 to 1.88, N 1.64, O 1.42 to
  /// 1.46, S 1.77). All other atoms have the radii above.
  united_atom,
  of_structure,  ///< that its file gives (PQR)
  of_table       ///< of a file of radii
};
/// "all-atom", "united-atom", "of the structure's file", "of a table".
std::string to_string(AtomRadii radii);

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
  /// An expression such as "chain A and not residue 10-20" (docs/molecules.md). It takes the place of
  /// `hetero` and `waters`, which then do not count; `chains`, `hydrogens` and `alternate` take from what is
  /// selected. Empty: none.
  std::string select = {};
  /// "all-atom"; "united-atom"; "auto": those of the file if it has radii, otherwise united-atom for at least
  /// 10 residues of polymers of which fewer than half have their backbone's hydrogens at carbon, else
  /// all-atom; or the path of a table: lines "[RESIDUE] ATOM|ELEMENT RADIUS", # begins a comment, elements
  /// are spelt as Ca, an atom's own line counts more than its element's, and one with the residue more than
  /// both.
  std::string radii = "auto";
};

/// How many atoms of the model were not taken, each counted where it first applies, in this order.
struct AtomsLeftOut {
  std::size_t other_chains = 0;
  std::size_t waters = 0;
  std::size_t hetero = 0;
  std::size_t hydrogens = 0;
  std::size_t alternates = 0;
  std::size_t not_selected = 0;    ///< by the expression
  std::size_t without_radius = 0;  ///< in the file, which gives 0

  std::size_t total() const {
    return other_chains + waters + hetero + hydrogens + alternates + not_selected + without_radius;
  }
  /// "106 of waters, 17 hetero"; empty if none.
  std::string described() const;
};

struct Molecule {
  std::vector<Atom> atoms;  ///< at least one, in the order of the file
  std::size_t atoms_in_model = 0;
  std::int64_t models = 1;  ///< in the file
  AtomsLeftOut left_out;
  AtomRadii radii = AtomRadii::all_atom;
  std::vector<std::string> warnings = {};  ///< what was odd in the file or guessed, a sentence each
};

/// Throws InvalidArgument, saying how to have them, if this library was built without molecules
/// (MORSEL_WITH_MOLECULES=OFF); `what` needs them ("atomic-density").
void require_molecules(std::string_view what);

/// Reads a .pdb or .ent, a .cif or .mmcif, or a .pqr file (by extension, any case; compressed ones, too), by
/// gemmi. Of an mmCIF file, the first block with atoms counts. Of models that are not taken nothing is read
/// but that they are there. Elements and roles follow from the names of atoms and residues and from the
/// sequence (SEQRES, entity_poly), where columns are missing or cannot be right.
///
/// Throws BadInput, naming the file and, where there is one, line or row, if it is missing, unreadable,
/// damaged (a coordinate that is not a number) or of another kind; has no atoms, or none left by the options
/// (saying what they left out); has no such model or chain (listing the chains); or if an atom that is taken
/// is of no known element. The same for the file of radii. Throws InvalidArgument if `model` is below 1,
/// `alternate` is none of the above or `select` no expression, and as require_molecules() does.
Molecule read_molecule(const std::filesystem::path& path, const MoleculeOptions& options = {},
                       const Progress& progress = {});

/// The same in a format that is given, whatever the file's name.
Molecule read_molecule(const std::filesystem::path& path, MoleculeFormat format,
                       const MoleculeOptions& options = {}, const Progress& progress = {});

/// The same of a file's bytes, which may be compressed; `name` is what errors call it.
Molecule parse_molecule(std::string_view bytes, MoleculeFormat format, const std::string& name,
                        const MoleculeOptions& options = {}, const Progress& progress = {});

/// The options as keys: hetero=none|residues|all, waters=yes|no, hydrogens=yes|no, altloc=…, chains=A/B,
/// model=1, select=…, radii=auto|all-atom|united-atom|FILE. Throws InvalidArgument also if select is given
/// with hetero or waters.
MoleculeOptions read_molecule_options(ParameterReader& reader);

/// The same keys with their values, as read_molecule_options() takes them; without hetero and waters where an
/// expression selects.
Parameters molecule_parameters(const MoleculeOptions& options);

}  // namespace morsel::core
