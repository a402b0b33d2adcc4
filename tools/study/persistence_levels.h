#pragma once
/// The hierarchy by persistence: levels of mscomplex::PersistenceHierarchy.

#include <cstddef>
#include <memory>
#include <vector>

#include "morsel/mscomplex/hierarchy.h"
#include "morsel/persistence/threshold.h"
#include "morsel/tools/study/level_builder.h"

namespace morsel::tools {

/// A field with its hierarchy, which levels made of it share.
struct FieldHierarchy {
  std::shared_ptr<const core::ScalarField> field;
  std::shared_ptr<const mscomplex::PersistenceHierarchy> hierarchy;
};

// The critical points of a level are the nodes of its complex, each its own parent; their values are those of
// the field, and their persistence is that at which the hierarchy cancels them (of a multiple saddle the
// largest).

/// The levels at which all pairs of at most a threshold's persistence are cancelled, by ascending threshold.
std::vector<LevelSeed> levels_by_threshold(const FieldHierarchy& from,
                                           std::vector<persistence::Threshold> thresholds);

/// The first levels with at most so many critical cells (minima, saddles with their multiplicities, maxima),
/// by descending number; a note says why where there are not as many as that.
std::vector<LevelSeed> levels_by_count(const FieldHierarchy& from, std::vector<std::size_t> counts);

}  // namespace morsel::tools
