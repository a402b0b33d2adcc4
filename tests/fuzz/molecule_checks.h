#pragma once
/// Checks of the targets of the molecules' formats.

#include "morsel/core/io/atom_records.h"

namespace morsel::fuzz {

/// Checks the invariants of all atoms of a file, and of those that options take.
void check_atoms(const core::AtomRecords& all);

}  // namespace morsel::fuzz
