#pragma once
/// The hierarchy by iteration: the fields that a smoothing method passes through (the paper's Example 3 and
/// Figure 4).

#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/level_builder.h"
#include "morsel/tools/study/registry.h"

namespace morsel::tools {

/// The text of a method or chain whose last step runs `needed` iterations: `method` itself if it gives a
/// number, else with that number added. Throws InvalidArgument if the last step has no iterations, listing
/// those that have, or if it is given fewer; and whatever make_method() throws.
std::string with_iterations(const std::string& method, int needed,
                            const Registry& registry = Registry::standard());

struct IterationLevels {
  ChainOutcome outcome;  ///< up to the last level; its field is that level's
  std::vector<LevelSeed> seeds;
};

/// Applies the chain to `input` and keeps the fields of its last step's iterations whose numbers are in
/// `levels` (ascending, not empty; 0 is that step's input). A critical point's parent is the one of the level
/// before that it came from, followed back through every iteration in between (morse::CriticalPointTracker,
/// by matching_radius() from one to the next). Throws InvalidArgument if the method ends before the last
/// level, or returns another field than that of its last iteration, and what methods throw.
IterationLevels iteration_levels(const MethodChain& chain, const core::LoadedMesh& loaded,
                                 const NamedFunction& function, const core::ScalarField& input,
                                 const std::vector<int>& levels, const core::Progress& progress = {});

}  // namespace morsel::tools
