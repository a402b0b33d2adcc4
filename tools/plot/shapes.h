#pragma once
/// Reduction of many points for drawing: clipping, and removal of invisible differences.

#include <cstddef>
#include <vector>

#include "morsel/tools/plot/canvas.h"

namespace morsel::tools::plot {

/// The parts of a line that lie in the box (Liang and Barsky 1984), without the points that move it by less
/// than 0.2.
std::vector<std::vector<Spot>> visible_line(const std::vector<Spot>& spots, const Box& box);

struct Marks {
  std::vector<Spot> spots;
  double cell = 0;  ///< one mark is left in each square of this size; 0 if all are
};

/// The marks in the box; if they are more than `limit`, the first one in each cell of the finest grid, from
/// 0.2 upwards, that leaves at most `limit`. O(n) and the area in cells.
Marks visible_marks(const std::vector<Spot>& spots, const Box& box, std::size_t limit);

}  // namespace morsel::tools::plot
