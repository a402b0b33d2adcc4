#pragma once
/// All of a complex at once, as arrays: for other languages, files and libraries of arrays.

#include <cstddef>
#include <vector>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/mscomplex/complex.h"

namespace morsel::mscomplex {

/// Nodes, arcs and quads by their numbers. O(result), parallel.
core::FlatArray<Node> nodes_of(const MorseSmaleComplex& complex);
core::FlatArray<Arc> arcs_of(const MorseSmaleComplex& complex);
core::FlatArray<Quad> quads_of(const MorseSmaleComplex& complex);

/// Polylines, one after the other.
struct Polylines {
  core::FlatArray<core::Point> points;
  std::vector<std::size_t> offsets;  ///< per polyline its first point, and the end
};

/// MorseSmaleComplex::trace() of every arc, in the order of the arcs. Time and memory: the sum of the arcs'
/// lengths, twice as much memory meanwhile; parallel, the same bits for every number of threads.
Polylines polylines_of(const MorseSmaleComplex& complex, const core::Progress& progress = {});

}  // namespace morsel::mscomplex
