#include "morsel/tools/plot/canvas.h"

#include <cmath>

namespace morsel::tools::plot {

std::vector<double> dash_lengths(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return {4, 2};
    case Dash::dotted:
      return {1, 1.5};
    case Dash::dash_dot:
      return {5, 1.5, 1, 1.5};
    case Dash::solid:
      break;
  }
  return {};
}

std::vector<Spot> mark_corners(Mark mark, double radius) {
  // About the area of the disc each.
  const double r = radius;
  switch (mark) {
    case Mark::triangle:
      return {{0, -1.4 * r}, {1.3 * r, 0.9 * r}, {-1.3 * r, 0.9 * r}};
    case Mark::diamond:
      return {{0, -1.35 * r}, {1.2 * r, 0}, {0, 1.35 * r}, {-1.2 * r, 0}};
    case Mark::square:
    case Mark::disc:
      break;
  }
  return {{-0.9 * r, -0.9 * r}, {0.9 * r, -0.9 * r}, {0.9 * r, 0.9 * r}, {-0.9 * r, 0.9 * r}};
}

}  // namespace morsel::tools::plot
