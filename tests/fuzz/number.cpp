#include "number.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace morsel::fuzz {

bool same_number(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace morsel::fuzz
