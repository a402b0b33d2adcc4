#pragma once
/// The residues and atoms at the segments of a molecular surface, for PyMOL, ChimeraX and others.

#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/molecule.h"
#include "morsel/tools/color/color.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/segment_atoms.h"

namespace morsel::tools {

/// The atoms of the segments of one surface, or of a level of a hierarchy.
struct SegmentedAtoms {
  std::vector<SegmentAtom> atoms;  ///< as atoms_of_segments() has them
  std::vector<Color> palette;      ///< a colour for each segment, as color_labels() gives them
};

/// ".pml", ".cxc", ".pdb" or ".csv", of the file's name. Throws InvalidArgument on another one.
std::string residues_extension(const core::FileTarget& target);

/// Writes them in the format of the extension, the levels one after the other (`with_levels`: named by their
/// numbers, 0 the finest; otherwise there is one):
///   .pml  PyMOL: a selection segment_N, or level_L_segment_N, of the residues of each segment; a residue is
///         coloured by the segment that most of its surface lies in
///   .cxc  ChimeraX: the same, with named specifications
///   .pdb  the atoms, with the segment that most of an atom's surface lies in as temperature factor (columns
///         61 to 66), -1 for those that are not at the surface; levels are models 1, 2, …
///   .csv  a row for each atom of each segment, with its part of the segment's area
/// Atoms that follow each other with the same chain, number and name are a residue, until the name of an atom
/// comes again. Scripts refer to it by
/// chain and number where these are letters and digits and no other residue has both, otherwise to its atoms
/// by their serial numbers: no name gets into a command. Throws InvalidArgument on another extension,
/// BadInput if names, coordinates or segments do not fit into a PDB file, or if a script would have to name
/// atoms by serial numbers that are negative or those of others, too; WriteFailed.
void write_residues(const core::FileTarget& target, std::span<const core::Atom> atoms,
                    std::span<const SegmentedAtoms> levels, bool with_levels, const Provenance& provenance);

}  // namespace morsel::tools
