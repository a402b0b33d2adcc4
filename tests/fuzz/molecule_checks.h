#pragma once
/// What the targets of the molecules' formats share.

#include "morsel/core/io/atom_records.h"

namespace morsel::fuzz {

/// What must hold of all atoms of a file, and of those that options take.
void check_atoms(const core::AtomRecords& all);

}  // namespace morsel::fuzz
