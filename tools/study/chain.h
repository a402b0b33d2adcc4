#pragma once
/// Applying a chain of methods: records of each step, origins of critical points, and a target number.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/tracking.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/target.h"

namespace morsel::tools {

/// What methods need besides the field, from the other modules. Refers to all of it.
core::MethodContext method_context(const core::LoadedMesh& loaded, const NamedFunction& function,
                                   const core::Progress& progress = {});

/// The outcome of one step of a chain.
struct StepOutcome {
  std::string name;
  core::Parameters parameters;
  core::Parameters details;
  std::vector<core::IterationRecord> iterations;  ///< if they were counted
  std::optional<core::IterationEnd> end = {};
  std::optional<double> sigma = {};  ///< core::MethodResult's
  std::vector<std::string> warnings = {};
};

struct ChainOptions {
  std::optional<std::size_t> target = {};  ///< critical points to end with; the last step is adapted to it
  bool count_iterations = false;           ///< of iterative methods
  morse::CriticalPointTracker* tracker =
      nullptr;  ///< made for the input; advanced by every field that is passed through
  /// As core::MethodContext's, for the last step only; its input is reported first, as iteration 0, and
  /// returned if the callback ends the step there. A search for a target may start the step again.
  core::IterationCallback on_iteration = {};
};

struct ChainOutcome {
  core::ScalarField field;
  std::vector<StepOutcome> steps;
  std::optional<TargetOutcome> target;
};

/// Applies the steps one after the other. Throws what functions and methods throw.
ChainOutcome apply_chain(const MethodChain& chain, const core::LoadedMesh& loaded,
                         const NamedFunction& function, const core::ScalarField& field,
                         const ChainOptions& options = {}, const core::Progress& progress = {});

}  // namespace morsel::tools
