#pragma once
/// The arcs of a complex as lines to draw, each piece of them once.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/mscomplex/complex.h"

namespace morsel::tools::html {

/// The arcs of one kind as polylines. The common part of arcs that merge belongs to the arc of the saddle
/// with the largest reach (arc_reach()), and the other arcs end where they meet it. So a piece is shown up to
/// its polyline's reach, and there are no more pieces than cells and saddles, however long the arcs are.
///
/// Descending: cells are vertices, from the saddle's on. Ascending: cells are triangles, and the line runs
/// from the saddle's vertex by their barycentres and the midpoints of the edges between them, in which it may
/// end as well.
struct ArcPaths {
  std::vector<std::uint32_t> saddle;  ///< per polyline: the saddle's vertex
  std::vector<double> reach;          ///< per polyline: the persistence up to which it is shown
  std::vector<std::uint32_t> length;  ///< per polyline: its number of cells
  std::vector<std::uint8_t> end;      ///< per polyline: its end after its last cell (kEnd…)
  std::vector<std::uint32_t> cells;   ///< of all polylines, one after the other

  static constexpr std::uint8_t kEndThere = 0;   ///< nowhere
  static constexpr std::uint8_t kEndCorner = 1;  ///< 1 + i: to corner i of the triangle, the maximum
  static constexpr std::uint8_t kEndSide =
      4;  ///< 4 + i: to the middle of side i, from corner i on: the boundary
  static constexpr std::uint8_t kOnlySide =
      7;  ///< 7 + i: the line is from the saddle's vertex to there, and no more
};

/// `reach` is by saddle. O(n + s log s).
ArcPaths descending_paths(const mscomplex::MorseSmaleComplex& complex, std::span<const double> reach);
ArcPaths ascending_paths(const mscomplex::MorseSmaleComplex& complex, std::span<const double> reach);

}  // namespace morsel::tools::html
