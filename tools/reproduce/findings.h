#pragma once
/// Sentences about a figure, from its numbers.

#include <string>

#include "morsel/tools/reproduce/outcome.h"

namespace morsel::tools::reproduce {

/// Figure 1: how many points of panel 1 are left in panel 3, and the mean saliency percentile of the extrema.
std::string fewer_and_where(const FigureOutcome& figure);
/// Figure 2: arcs and segments of both panels.
std::string simpler_complex(const FigureOutcome& figure);
/// Figure 3: the count at the paper's threshold, and what both methods keep in the region and all over.
std::string region_compared(const FigureOutcome& figure);
/// Figure 4: points and segments by level, and how many points are kept, moved and new.
std::string levels_linked(const FigureOutcome& figure);

/// Section 3.1: what the highest and the lowest vertex of the field (panel 0) are in each panel.
std::string types_of_ends(const FigureOutcome& figure);

}  // namespace morsel::tools::reproduce
