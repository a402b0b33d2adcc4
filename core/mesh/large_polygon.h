#pragma once
/// Ear clipping of polygons with many corners. Internal to the triangulation of polygons.

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

/// Appends the triangles of the polygon by ear clipping (Meisters 1975), the next ear in turn. An ear is a
/// corner whose diagonal is not an edge yet and whose triangle contains no reflex corner. In a simple polygon
/// a cut changes which corners are ears at its two ends only (O'Rourke 1998, 1.4), so that ears are kept in a
/// set and tested again only there; reflex corners are kept in a CornerTree. Usually O(n log n) for n
/// corners; `tests_left` is lowered by the number of tests, and the function returns false if it would become
/// negative.
///
/// If no corner is an ear, as in a polygon with crossing sides or collinear corners, a best shaped corner is
/// cut off, and all corners are tested again from time to time.
bool cut_large_polygon(const PlacedPolygon& polygon, EdgeSet& edges, std::uint64_t& tests_left,
                       std::vector<Triangle>& triangles, const Progress& progress);

}  // namespace morsel::core
