#pragma once
/// Grids of quads over squares and pentagons. Internal.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "morsel/core/types.h"

namespace morsel::mscomplex {

/// A grid with n quads along each side of a polygon (patch.h says where its corners are). A square has n × n
/// quads; a pentagon falls into five quads, each between a corner, the middles of the sides there and that of
/// the pentagon, with n/2 × n/2 quads each.
struct PolygonGrid {
  /// Vertex s · n + k is at k/n of side s; those inside follow.
  std::vector<std::array<core::Index, 4>> quads;
  std::vector<Eigen::Vector2d> inside;  ///< places
};

/// Of 4 sides, or of 5 with an even n.
PolygonGrid polygon_grid(int sides, core::Index n);

}  // namespace morsel::mscomplex
