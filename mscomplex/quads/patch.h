#pragma once
/// The patches of a layout over the unit square. Internal.

#include <Eigen/Core>
#include <vector>

#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/disc.h"

namespace morsel::mscomplex {

/// The layout's surface with its arcs as labels, and with every other edge split whose ends both lie on arcs:
/// such an edge may join two vertices of one side of a patch.
LayoutMesh labelled_surface(const QuadLayout& layout);

/// A patch over a regular polygon with a corner at each end of its sides, counter-clockwise: the unit square,
/// from the origin on, or, for one at a boundary loop, a pentagon about the origin. Its corners are nodes 3,
/// 0, 1 and 2 of the layout's quad, the last replaced by the two ends of the piece of the loop; so its sides
/// are arcs 3, 0 and 1, that piece if there is one, and arc 2.
struct PatchMap {
  Disc disc;
  std::vector<core::Index> corner;     ///< border vertices, and border_size()
  std::vector<Eigen::Vector2d> place;  ///< per disc vertex
  int sides() const { return static_cast<int>(corner.size()) - 1; }
};

/// Corner i of the polygon.
Eigen::Vector2d polygon_corner(int sides, int i);

/// Where the patch lies on the surface; `place` is left empty. Throws std::logic_error if it is not a disc
/// between its sides.
PatchMap find_patch(const LayoutMesh& mesh, const QuadLayout& layout, core::Index q, DiscFinder& finder);
/// Fills `place`: sides by arc length, the inside with mean-value coordinates.
void parametrise(const LayoutMesh& mesh, core::Index q, PatchMap& patch);
/// The points of the surface at these places in the polygon into `samples`. Throws BadInput, naming patch q,
/// if the parametrisation has collapsed there.
void sample_inside(const LayoutMesh& mesh, core::Index q, const PatchMap& patch,
                   const std::vector<Eigen::Vector2d>& places, core::Point* samples);

}  // namespace morsel::mscomplex
