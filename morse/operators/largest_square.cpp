#include "morsel/morse/operators/largest_square.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace morsel::morse {

double largest_square(double radius) {
  double square = std::min(radius * radius, std::numeric_limits<double>::max());
  while (std::sqrt(square) > radius) square = std::nextafter(square, 0.0);
  for (;;) {
    const double next = std::nextafter(square, std::numeric_limits<double>::infinity());
    if (!std::isfinite(next) || std::sqrt(next) > radius) return square;
    square = next;
  }
}

}  // namespace morsel::morse
