#pragma once
/// The quadrilateral surface of a solid on a grid. Internal.

#include <array>
#include <span>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/core/types.h"
#include "morsel/tools/molecule/solid.h"

namespace morsel::tools {

struct Grid {
  core::Point origin;  ///< a point of the grid
  double spacing;      ///< in Å
};

struct QuadMesh {
  std::vector<core::Point> positions;
  std::vector<std::array<core::Index, 4>> quads;  ///< counter-clockwise seen from outside
};

/// The surface of a solid by dual contouring of a grid (OpenVDB's volumeToMesh): a vertex in each cell that
/// the surface passes, at the mean of where it cuts the cell's edges, and a quadrilateral around each edge
/// that it cuts. Cuts are kept 1 % of the spacing away from the grid's points, so that no two vertices
/// coincide. It is closed, and on every grid tried (white noise, too) was a manifold, which OpenVDB does not
/// promise, so the caller must check. The same bits for any number of threads.
QuadMesh mesh_solid(const Solid& solid, std::span<const Ball> balls, const Grid& grid,
                    const core::Progress& progress);

/// The number of grid points at which mesh_solid() would evaluate, or somewhat more.
double grid_size(const Solid& solid, std::span<const Ball> balls, double spacing);

}  // namespace morsel::tools
