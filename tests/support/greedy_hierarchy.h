#pragma once
/// Cancellation arc by arc, as published: the oracle of the hierarchy, and the baseline of its benchmark.

#include <vector>

#include "morsel/mscomplex/complex.h"

namespace morsel::test {

struct GreedyCancellation {
  core::Index saddle;    ///< node
  core::Index extremum;  ///< node
  double persistence;
};

/// Cancels the saddle and extremum at the ends of the shortest arc (by the difference of its values) again
/// and again (Bremer et al. 2004), as long as there is one whose saddle's two arcs of that kind end in
/// different nodes and one of these is no cap. Lists of arcs at nodes, a queue of arcs, relabelling of all
/// arcs that change their end. Equal differences come in no particular order.
std::vector<GreedyCancellation> cancel_greedily(const mscomplex::MorseSmaleComplex& complex);

}  // namespace morsel::test
