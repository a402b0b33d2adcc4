#pragma once
/// Elements of atoms and roles of residues, from their names. Internal.

#include "morsel/core/io/atom_records.h"

namespace morsel::core {

/// Completes records of which names, and what else the file has, are known: element, radius by element,
/// polymer, water, ion, and whether they are left out by default. Whatever columns a program leaves out, the
/// names of atom and residue together tell most of it:
/// - A residue of the sequence, an amino acid or a nucleotide (of the PDB as gemmi knows them, of simulations
///   as residue_names.h does), or an unknown residue of ATOM records with the atoms of a backbone, is
///   polymer.
/// - A residue with a name of waters whose atoms are those of a water is one.
/// - An atom that is called as its residue, where that is a name of ions, is an ion.
/// - Elements of polymers and waters follow from their atoms' names; the file's own symbol of the element
///   counts where it is possible there.
/// Sites of water models and lone pairs, which are no atoms (MW, EPW, LP1), are removed. What contradicts is
/// told in `warnings`. O(n).
void identify_atoms(AtomRecords& all);

}  // namespace morsel::core
