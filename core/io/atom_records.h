#pragma once
/// All atoms of a PDB or mmCIF file, before any is chosen. Internal.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/molecule.h"

namespace morsel::core {

struct AtomRecord {
  Atom atom;
  std::int64_t model = 1;  ///< which one of the file, counted from 1
  bool hydrogen = false;   ///< or deuterium
};

struct AtomRecords {
  std::vector<AtomRecord> records;  ///< in the order of the file, models one after the other
  std::int64_t models = 0;          ///< that have atoms
};

/// Reads them from the bytes of a file; `file` names it in errors. An atom of unknown element has the element
/// "X" and no radius. Both throw BadInput for a damaged file; one without atoms gives no records.
AtomRecords read_pdb(std::string_view bytes, const std::string& file, const Progress& progress);
AtomRecords read_mmcif(std::string_view bytes, const std::string& file, const Progress& progress);

/// The atoms that the options select, as read_molecule() describes. Throws BadInput and InvalidArgument as it
/// does.
Molecule choose_atoms(AtomRecords all, const std::string& file, const MoleculeOptions& options);

}  // namespace morsel::core
