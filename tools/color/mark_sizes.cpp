#include "morsel/tools/color/mark_sizes.h"

#include <algorithm>
#include <cmath>

namespace morsel::tools {

MarkSizes mark_sizes(double area, std::size_t points) {
  const double spacing = points > 0 ? std::sqrt(area / static_cast<double>(points)) : 1;
  const double ball = std::clamp(0.13 * spacing, 0.0025, 0.0085);
  return {ball, std::clamp(0.4 * ball, 0.0011, 0.0026)};
}

}  // namespace morsel::tools
