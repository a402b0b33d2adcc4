#pragma once
/// The patches of a layout over the unit square. Internal.

#include <Eigen/Core>
#include <vector>

#include "morsel/mscomplex/quads.h"
#include "morsel/mscomplex/quads/disc.h"

namespace morsel::mscomplex {

/// The layout's surface with its arcs as labels, and with every other edge split whose ends both lie on arcs: such an edge
/// may join two vertices of one side of a patch.
LayoutMesh labelled_surface(const QuadLayout& layout);

/// A patch over the unit square. Its corners are, counter-clockwise from the origin on, nodes 3, 0, 1 and 2 of the
/// layout's quad; so its sides are arcs 3, 0, 1 and 2, the first and third as they leave their saddles.
struct PatchMap {
  Disc disc;
  std::array<core::Index, 5> corner;   ///< border vertices; the last is border_size()
  std::vector<Eigen::Vector2d> place;  ///< per disc vertex
};

/// Where the patch lies on the surface; `place` is left empty. Throws std::logic_error if it is not a disc between its
/// four arcs.
PatchMap find_patch(const LayoutMesh& mesh, const QuadLayout& layout, core::Index q, DiscFinder& finder);
/// Fills `place`: sides by arc length, the inside with mean-value coordinates.
void parametrise(const LayoutMesh& mesh, core::Index q, PatchMap& patch);
/// The points at (i, j)/n, 0 < i, j < n, row by row (j), into `samples`. Throws BadInput, naming patch q, if the
/// parametrisation has collapsed there.
void sample_inside(const LayoutMesh& mesh, core::Index q, const PatchMap& patch, core::Index n,
                   core::Point* samples);

}  // namespace morsel::mscomplex
