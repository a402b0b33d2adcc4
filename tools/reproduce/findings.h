#pragma once
/// What is seen in a figure, said from its numbers.

#include <string>

#include "morsel/tools/reproduce/outcome.h"

namespace morsel::tools::reproduce {

/// Figure 1: how many points are left of panel 1 in panel 3, and how salient (panel 2) the places are where
/// they lie.
std::string fewer_and_where(const FigureOutcome& figure);
/// Figure 2: arcs and segments of both panels.
std::string simpler_complex(const FigureOutcome& figure);
/// Figure 3: what the paper's threshold would leave, and what both methods keep in the region.
std::string region_compared(const FigureOutcome& figure);
/// Figure 4: points and segments from level to level, and what became of the points.
std::string levels_linked(const FigureOutcome& figure);

}  // namespace morsel::tools::reproduce
