#pragma once
/// The ends of runs in the links of saddles. For the module's own use.

#include <span>
#include <vector>

#include "morsel/core/field/link_changes.h"
#include "morsel/core/field/scalar_field.h"
#include "morsel/persistence/paths.h"

namespace morsel::persistence::detail {

using core::Index;

/// The lower and the higher elements of the changes around saddles (vertices, or the number of vertices +
/// loop for a cap). A run of a link begins and ends with a change, so each run is listed twice. At one
/// saddle they are in any order.
struct LinkEnds {
  std::vector<Index> offset;  ///< per vertex: where the entries of a saddle begin in both lists
  std::vector<Index> lower, higher;
};

struct Saddle {
  Index rank;
  Index multiplicity;
  /// The number of changes in its link: its runs of lower elements, one more than its multiplicity, begin and
  /// end with one.
  Index changes() const { return 2 * (multiplicity + 1); }
};

/// For the saddles of the field; O(n), parallel. If there are many, another pass over the triangles finds
/// them and also sets an element below or above each vertex as the next one of the paths; otherwise the links
/// of the saddles are walked.
LinkEnds link_ends(const core::ScalarField& field, std::span<const core::LinkChanges> types,
                   std::span<const Saddle> saddles, Paths& down_to_minima, Paths& up_to_maxima);

}  // namespace morsel::persistence::detail
