#include "morsel/mscomplex/quads/polygon_grid.h"

#include "morsel/mscomplex/quads/patch.h"

namespace morsel::mscomplex {

using core::Index;
using Eigen::Vector2d;

namespace {

PolygonGrid square(Index n) {
  PolygonGrid grid;
  const auto at = [&](Index i, Index j) -> Index {
    if (j == 0 && i < n) return i;
    if (i == n && j < n) return n + j;
    if (j == n && i > 0) return 2 * n + (n - i);
    if (i == 0) return 3 * n + (n - j);
    return 4 * n + (j - 1) * (n - 1) + (i - 1);
  };
  for (Index j = 1; j < n; ++j)
    for (Index i = 1; i < n; ++i) grid.inside.emplace_back(double(i) / n, double(j) / n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      grid.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return grid;
}

PolygonGrid pentagon(Index n) {
  PolygonGrid grid;
  const Index half = n / 2;
  const Index first_inside = 5 * n;
  // Inside: the middle, then those between it and the middle of each side, then the inside of each corner's
  // quad.
  const auto on_spoke = [&](Index side, Index k) { return first_inside + 1 + side * (half - 1) + (k - 1); };
  const auto at = [&](Index c, Index i, Index j) -> Index {
    const Index before = (c + 4) % 5;
    if (j == 0) return c * n + i;
    if (i == 0) return before * n + (n - j);
    if (i == half && j == half) return first_inside;
    if (i == half) return on_spoke(c, j);
    if (j == half) return on_spoke(before, i);
    return first_inside + 1 + 5 * (half - 1) + c * (half - 1) * (half - 1) + (j - 1) * (half - 1) + (i - 1);
  };
  const auto middle_of_side = [](int c) -> Vector2d {
    return (polygon_corner(5, c) + polygon_corner(5, c + 1)) / 2;
  };
  grid.inside.emplace_back(0, 0);
  for (int c = 0; c < 5; ++c)
    for (Index k = 1; k < half; ++k) grid.inside.emplace_back((1 - double(k) / half) * middle_of_side(c));
  for (int c = 0; c < 5; ++c)
    for (Index j = 1; j < half; ++j)
      for (Index i = 1; i < half; ++i) {
        const double s = double(i) / half;
        const double t = double(j) / half;
        grid.inside.emplace_back((1 - s) * (1 - t) * polygon_corner(5, c) + s * (1 - t) * middle_of_side(c) +
                                 (1 - s) * t * middle_of_side(c + 4));
      }
  for (Index c = 0; c < 5; ++c)
    for (Index j = 0; j < half; ++j)
      for (Index i = 0; i < half; ++i)
        grid.quads.push_back({at(c, i, j), at(c, i + 1, j), at(c, i + 1, j + 1), at(c, i, j + 1)});
  return grid;
}

}  // namespace

PolygonGrid polygon_grid(int sides, Index n) { return sides == 4 ? square(n) : pentagon(n); }

}  // namespace morsel::mscomplex
