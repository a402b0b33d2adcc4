#pragma once
/// The quad of the complex that each triangle lies in.

#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/types.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// The quad that each triangle belongs to; kNone in components that have no saddle and so no quad. `complex`
/// must be the field's own, from its lower stars.
///
/// The triangles that flow into one maximum or cap make a disc, unfolded along the edges that they cross. Its
/// rim runs along critical edges and along edges that vertices descend by; between two consecutive
/// critical edges it stays within the tree of one minimum, and that stretch is the rim of one quad: the
/// ascending arcs from the two edges, and what lies between them. Every corner of a triangle lies on one
/// stretch. A triangle off the arcs has all corners on the same one; one that an arc runs through has them on
/// both sides, and belongs to the quad of its lowest corner. So a triangle's quad has the minimum of its
/// lowest vertex and the triangle's maximum or cap, and it distinguishes the quads that have both in common.
///
/// The closed triangles of a quad are connected, except those of a cap, which may be connected only through
/// the cap: a triangle at an edge of the stretch, which its upper end descends by, has its lowest corner
/// there, and neighbours on the stretch share corners. A quad may be too thin to have any triangle.
///
/// O(n), parallel over the saddles; the same for every number of threads.
std::vector<core::Index> quad_of_triangles(const core::ScalarField& field, const MorseSmaleComplex& complex);

/// The number of cells: the quads that have a triangle, and the components that have no quad. Of a complex by
/// lower stars or of any level of a hierarchy, for whose gradient the above holds as well. O(n).
core::Index cell_count(const core::ScalarField& field, const MorseSmaleComplex& complex);

}  // namespace morsel::mscomplex
