#include "morsel/morse/smoothing/monomial_tables.h"

#include <array>
#include <cstdint>

namespace morsel::morse {
namespace {

MonomialTables make_tables() {
  MonomialTables tables{};
  constexpr int kOrder = MonomialTables::kOrder;
  std::array<std::array<std::array<int, kOrder + 1>, kOrder + 1>, kOrder + 1> number{};
  int count = 0;
  for (int degree = 0; degree <= kOrder; ++degree)
    for (int x = degree; x >= 0; --x)
      for (int y = degree - x; y >= 0; --y) {
        const std::array<int, 3> powers = {x, y, degree - x - y};
        number[x][y][powers[2]] = count;
        for (std::uint8_t axis = 0; axis < 3; ++axis) {
          tables.powers[count][axis] = static_cast<std::uint8_t>(powers[axis]);
          if (powers[axis] == 0) continue;
          std::array<int, 3> less = powers;
          --less[axis];
          tables.axis[count] = axis;
          tables.parent[count] = static_cast<std::uint8_t>(number[less[0]][less[1]][less[2]]);
          tables.factor[count] = 1 / static_cast<float>(powers[axis]);
        }
        ++count;
      }
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      std::array<int, 3> sum{};
      for (int axis = 0; axis < 3; ++axis) sum[axis] = tables.powers[a][axis] + tables.powers[b][axis];
      if (sum[0] + sum[1] + sum[2] <= kOrder)
        tables.sums[a][b] = static_cast<std::uint8_t>(number[sum[0]][sum[1]][sum[2]]);
    }
  return tables;
}

}  // namespace

const MonomialTables& monomial_tables() {
  static const MonomialTables kTables = make_tables();
  return kTables;
}

}  // namespace morsel::morse
