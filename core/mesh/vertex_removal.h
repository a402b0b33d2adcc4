#pragma once
/// Leaving vertices out of a polygon soup. Internal to build_mesh(), which documents what is done.

#include <cstddef>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/mesh/mesh_repair.h"

namespace morsel::core {

/// What is left of a soup.
struct ReducedSoup {
  PolygonSoup soup;
  VertexNumbering numbering;       ///< to the whole soup; tables are empty if no vertex went
  std::vector<Index> polygons;     ///< per polygon its number in the whole soup; empty if none went
  std::vector<bool> rim;           ///< per vertex whether a polygon at it went; empty if none went
  std::size_t vertex_count = 0;    ///< vertices that went, those that no polygon is left at among them
  std::size_t polygon_count = 0;   ///< polygons that went
  std::size_t stranded_count = 0;  ///< vertices that went because no polygon is left at them
};

/// Takes out the vertices where `left_out` is true, and the polygons at them. Vertices that no polygon used
/// before stay, as do corners that name no vertex. Throws InvalidArgument unless `left_out` has an entry for
/// each vertex, BadInput if there were polygons and none is left. O(n).
ReducedSoup leave_out(PolygonSoup soup, const std::vector<bool>& left_out);

}  // namespace morsel::core
