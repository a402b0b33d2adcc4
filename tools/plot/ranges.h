#pragma once
/// The ranges of a plot's axes.

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/plot/ticks.h"

namespace morsel::tools::plot {

struct Ranges {
  Interval x;
  Interval y;
  bool infinity = false;  ///< whether there is something at y = +∞
};

/// Throws InvalidArgument if the plot's numbers cannot be drawn, as write_svg() says.
Ranges ranges_of(const Plot& plot);

}  // namespace morsel::tools::plot
