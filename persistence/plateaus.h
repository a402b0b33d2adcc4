#pragma once
/// An order of the vertices of equal value that makes no extremum but the wanted ones. For the module's own
/// use.

#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/persistence/reconstruction.h"

namespace morsel::persistence::detail {

/// Orders all vertices of a flooded and carved field so that the extrema are exactly those that `roles` name.
/// Within a level (levels.h) f's order is kept where that suffices; else the minima come first and the maxima
/// last, both in f's order, and each connected plateau between them is numbered so that all its vertices have
/// a lower and a higher neighbour (a cap counts as higher): an st-numbering with all lower vertices as source
/// and all higher ones as sink. Only levels that vertices were moved to need it; the rest of the order is
/// shifted as a whole.
///
/// Such an order exists because the link of a vertex is a cycle, so that no single vertex can cut a part of a
/// plateau off from both. It needs every plateau to touch something lower (or a minimum of its own level) and
/// something higher, which flooding and carving ensure; std::logic_error is thrown if one does not.
///
/// `roles` has one entry a vertex. Returns the ranks. O(n + k log k) for k vertices moved, parallel.
core::FlatArray<Index> order_plateaus(const core::ScalarField& f, const Releveled& releveled,
                                      std::span<const Role> roles);

}  // namespace morsel::persistence::detail
