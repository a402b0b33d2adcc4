#pragma once
/// The total order of vertices that a field's values induce.

#include <span>

#include "morsel/core/parallel/flat_array.h"
#include "morsel/core/types.h"

namespace morsel::core {

/// The vertices by ascending (value, vertex): simulation of simplicity (Edelsbrunner, Mücke 1990). −0 equals
/// 0; NaN, if any, comes first or last. A radix sort of the leading 32 bits in which the values differ, again
/// for many values that agree in them, and by comparisons for few: O(n). Parallel, the same for every number
/// of threads. Memory: 16 bytes a vertex besides the result.
FlatArray<Index> vertex_order(std::span<const double> values);

/// The same with vertices of equal value in the order of `before`, a permutation of the vertices.
FlatArray<Index> vertex_order(std::span<const double> values, std::span<const Index> before);

/// The position of each element: inverse(p)[p[i]] = i. `permutation` must be one.
FlatArray<Index> inverse(std::span<const Index> permutation);

}  // namespace morsel::core
