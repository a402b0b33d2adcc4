#pragma once
/// The combinations of a parameter sweep: requests, and plans.

#include <cstddef>
#include <string>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/variation.h"

namespace morsel::tools {

/// A parameter sweep in the syntax of the command line.
struct SweepRequest {
  std::string field = "mean-curvature";
  std::string method = "salient";  ///< or a chain
  std::vector<std::string> vary;   ///< see parse_variation()
};

/// One value of each variation, and the field and method with these values.
struct Combination {
  std::vector<std::size_t> choices;  ///< for each variation, which of its values
  core::Specification field;
  std::vector<core::Specification> steps;
};

/// A request whose names and values have been looked up: all combinations; those that differ in the
/// last variation alone are consecutive.
struct SweepPlan {
  std::vector<Variation> variations;
  std::vector<Combination> combinations;
  Registry registry;  ///< a copy of the one that it was made with
};

/// The most combinations of one sweep.
inline constexpr std::size_t kMostCombinations = 1'000'000;

/// A key is looked for in the field and in all steps of the method; if several have it, it is written
/// "field.KEY", "NAME.KEY" or, with the number of the step from 1 on, "2.KEY".
///
/// Throws InvalidArgument if nothing varies, on keys that neither the field nor a step has or that are
/// ambiguous, that vary twice or also have a fixed value, on any combination for which make_function() or
/// make_method() throws, and on more than kMostCombinations. Touches no file.
SweepPlan prepare(const SweepRequest& request, const Registry& registry = Registry::standard());

}  // namespace morsel::tools
