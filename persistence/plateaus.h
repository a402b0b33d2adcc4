#pragma once
/// An order of the vertices of equal value that makes no extremum but the wanted ones. For the module's own
/// use.

#include <cstdint>
#include <span>
#include <vector>

#include "morsel/core/scalar_field.h"

namespace morsel::persistence::detail {

using core::Index;

/// What cancellation wants a vertex to become.
enum class Role : std::uint8_t { regular, minimum, maximum };  // regular: anything but an extremum

/// Orders all vertices by (level, …) so that the extrema are exactly those that `roles` name. Within a level
/// f's order is kept where it does that; else the minima come first and the maxima last, both in f's order,
/// and each connected plateau between them is numbered so that all its vertices have a lower and a higher
/// neighbour (a cap counts as higher): an st-numbering (Tarjan 1986, "Two streamlined depth-first search
/// algorithms") with all that lies lower as source and all that lies higher as sink.
///
/// It exists because the link of a vertex is a cycle, so that no single vertex can cut a part of a plateau
/// off from both. It needs every plateau to touch something lower (or a minimum of its own level) and
/// something higher, which flooding and carving see to; std::logic_error is thrown if one does not.
///
/// `level` and `roles` have one entry a vertex; levels are below level_count. Returns the ranks. O(n).
std::vector<Index> order_plateaus(const core::ScalarField& f, std::span<const Index> level, Index level_count,
                                  std::span<const Role> roles);

/// The vertices by ascending (level, rank in f): a counting sort. `offsets` gets the first position of each
/// level, and the end. O(n).
std::vector<Index> sort_by_level(const core::ScalarField& f, std::span<const Index> level, Index level_count,
                                 std::vector<Index>& offsets);

}  // namespace morsel::persistence::detail
