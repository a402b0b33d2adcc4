#pragma once
/// How large critical points and arcs are shown.

#include <cstddef>

namespace morsel::tools {

/// Radii, in diagonals of the surface's bounding box.
struct MarkSizes {
  double ball;
  double tube;
};

/// Large enough to be visible and small enough that so many points, spread over a surface of this area (in
/// squared diagonals), do not hide it.
MarkSizes mark_sizes(double area, std::size_t points);

}  // namespace morsel::tools
