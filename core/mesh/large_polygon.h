#pragma once
/// Cutting polygons of many corners. Internal to the triangulation of polygons.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/mesh/polygon_triangulation.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// A polygon that is placed and scaled as PolygonTriangulator does it.
struct PlacedPolygon {
  std::span<const Index> vertices;
  std::span<const Point> positions;  ///< of the corners, within a cube of edge length 2
  Point normal;                      ///< of unit length or zero

  /// The quality of corner b's triangle between corners a and c: 1 for an equilateral one, towards 0 for
  /// slivers, negative when seen from behind.
  double shape(std::size_t a, std::size_t b, std::size_t c) const;
};

/// Appends the triangles that are cut off from the polygon, the next ear in turn (Meisters 1975) as long as
/// there is one: a corner whose diagonal no edge has yet and in whose triangle no reflex corner lies. In a
/// simple polygon a cut makes or unmakes ears at its two ends only (O'Rourke 1998, 1.4), so that ears are
/// kept in a set and looked for again there alone; reflex corners are kept in a CornerTree. O(n log n) as a
/// rule for n corners; `tests_left` is lowered by the number of tests done, and cutting ends with false where
/// it would become negative.
///
/// Where no corner is an ear, as in a polygon whose sides cross or whose corners lie on a line, one of the
/// best shape is cut off, and the ears of the others are looked for again at times.
bool cut_large_polygon(const PlacedPolygon& polygon, EdgeSet& edges, std::uint64_t& tests_left,
                       std::vector<Triangle>& triangles, const Progress& progress);

}  // namespace morsel::core
