#pragma once
/// Conditions on a complex for a layout. Internal.

#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// Throws BadInput if some component has no saddle.
void require_arcs(const MorseSmaleComplex& complex);
/// Throws BadInput if some minimum or maximum has a single arc. (A cap may: its arc ends at the loop.)
void require_no_dangling(const MorseSmaleComplex& complex);

}  // namespace morsel::mscomplex
