#pragma once
/// The tables of the kernels for pairs of cells.

#include "morsel/morse/smoothing/cell_kernels.h"

namespace morsel::morse {

/// Computed once; thread-safe.
const MonomialTables& monomial_tables();

}  // namespace morsel::morse
