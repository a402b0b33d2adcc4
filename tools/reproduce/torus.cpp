#include "morsel/tools/reproduce/torus.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace morsel::tools::reproduce {

core::TriangleMesh standing_torus() {
  constexpr core::Index kAround = 96;
  constexpr core::Index kAcross = 48;
  constexpr double kRing = 1;
  constexpr double kTube = 0.4;
  std::vector<core::Point> positions;
  std::vector<core::Triangle> triangles;
  const auto number = [](core::Index i, core::Index j) { return i % kAround * kAcross + j % kAcross; };
  for (core::Index i = 0; i < kAround; ++i)
    for (core::Index j = 0; j < kAcross; ++j) {
      const double around = 2 * std::numbers::pi * i / kAround;
      const double across = 2 * std::numbers::pi * j / kAcross;
      const double reach = kRing + kTube * std::cos(across);
      positions.emplace_back(reach * std::cos(around), kTube * std::sin(across), reach * std::sin(around));
      triangles.push_back({number(i, j), number(i, j + 1), number(i + 1, j + 1)});
      triangles.push_back({number(i, j), number(i + 1, j + 1), number(i + 1, j)});
    }
  return {std::move(positions), std::move(triangles)};
}

}  // namespace morsel::tools::reproduce
