#pragma once
/// Building levels with their complexes and links.

#include <functional>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/study/level.h"

namespace morsel::tools {

/// A level before its complex is made.
struct LevelSeed {
  LevelName name;
  std::shared_ptr<const core::ScalarField> field;
  morse::CriticalPoints points;
  std::vector<double> persistence;   ///< per point
  std::vector<core::Index> parents;  ///< per point
  std::function<mscomplex::DiscreteGradient()>
      gradient;  ///< of the level, on the field's mesh; called when the level is built
};

/// Makes the levels, the finest first, and links the cells of each with those of the levels beside it. Each
/// is passed to `take` as soon as its links are complete, so that no more than two complexes are in memory.
/// Parallel, the same for every number of threads but for timings.
void build_levels(std::vector<LevelSeed> seeds, const std::function<void(Level)>& take,
                  const core::Progress& progress = {});

}  // namespace morsel::tools
