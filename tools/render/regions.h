#pragma once
/// Colours for segments.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/render/scene.h"

namespace morsel::tools::render {

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

}  // namespace morsel::tools::render
