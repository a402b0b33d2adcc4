#pragma once
/// What a complex needs to become a layout. Internal.

#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// Throws BadInput if the surface is bounded, or if some component has no saddle.
void require_arcs(const MorseSmaleComplex& complex);
/// Throws BadInput if some extremum has a single arc.
void require_no_dangling(const MorseSmaleComplex& complex);

}  // namespace morsel::mscomplex
