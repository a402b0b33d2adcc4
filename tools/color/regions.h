#pragma once
/// Colours for segments.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/color/color.h"

namespace morsel::tools {

/// A colour for each third of each triangle, that of the corner with the largest barycentric weight: entry 3t
/// + i for corner i. So a region may be made of triangles, of vertices' dual cells, or of both.
struct RegionColors {
  std::vector<std::uint32_t> corner;  ///< into `palette`
  std::vector<Color> palette;
};

/// Colours each node of a graph so that neighbours have clearly different colours: the most constrained node
/// first (Brélaz 1979), each in the colour that is farthest, in OKLab, from those of its neighbours, the less
/// used one of two. From eighteen pale colours, Tol's "light" ones and tints of them, and further tints where
/// a node has more neighbours than that. Returns a number in the palette for each node. O((nodes + edges) log
/// nodes) times the colours.
std::vector<std::uint32_t> color_graph(std::uint32_t nodes,
                                       std::span<const std::pair<std::uint32_t, std::uint32_t>> edges,
                                       std::vector<Color>& palette);

/// The segments of one kind. Descending ones are unions of triangles, bounded by descending arcs; ascending
/// ones of the vertices' dual cells, bounded by ascending arcs; Morse-Smale ones are their intersections.
RegionColors color_segments(const core::TriangleMesh& mesh, const mscomplex::Segmentation& segmentation,
                            mscomplex::SegmentKind kind);

/// A colour for each label from 0 to the largest, as color_graph() gives them: labels of triangles that share
/// an edge, and of their vertices, are neighbours.
std::vector<Color> color_labels(const core::TriangleMesh& mesh, std::span<const core::Index> vertex,
                                std::span<const core::Index> triangle);

}  // namespace morsel::tools
