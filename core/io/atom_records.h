#pragma once
/// All atoms of a PDB or mmCIF file, before any is chosen. Internal.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/molecule.h"

namespace morsel::core {

struct AtomRecord {
  Atom atom;
  std::string symbol;  ///< of the element, as the file has it: may be empty or none
  /// Of the name in a PDB file, columns 13 to 16, which may tell the element; zeros in other formats.
  std::array<char, 4> columns = {};
  bool in_sequence = false;  ///< the file's sequence of a chain has its residue
  bool stays_out = false;    ///< of a known ligand or lipid, whatever its record
  double own_radius = -1;    ///< that the file gives, in Å; negative: none
};

struct AtomRecords {
  std::vector<AtomRecord> records;    ///< of one model, in the order of the file
  std::int64_t models = 0;            ///< in the file, that have atoms
  std::vector<std::string> warnings;  ///< what was odd in the file, a sentence each
};

/// Reads one model, counted from 1, from the bytes of a file; `file` names it in errors. Of the other models
/// nothing is read but that they are there. An atom of unknown element has the element "X" and no radius. All
/// throw BadInput for a damaged file; one without atoms, or without that model, gives no records.
AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress,
                     std::int64_t model = 1);
AtomRecords read_mmcif(std::string_view bytes, const std::string& file, const Progress& progress,
                       std::int64_t model = 1);
/// PQR files have one model.
AtomRecords read_pqr(std::string_view bytes, const std::string& file, const Progress& progress);

/// The atoms that the options select, as read_molecule() describes. Throws BadInput and InvalidArgument as it
/// does.
Molecule choose_atoms(AtomRecords all, const std::string& file, const MoleculeOptions& options);

}  // namespace morsel::core
