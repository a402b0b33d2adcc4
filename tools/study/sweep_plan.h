#pragma once
/// A field and a method with every combination of some of their parameters' values: the combinations.

#include <cstddef>
#include <string>
#include <vector>

#include "morsel/core/text/specification.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/variation.h"

namespace morsel::tools {

/// In the words of the command line.
struct SweepRequest {
  std::string field = "mean-curvature";
  std::string method = "salient";  ///< or a chain
  std::vector<std::string> vary;   ///< see parse_variation()
};

/// One value of each variation, and what field and method are with them.
struct Combination {
  std::vector<std::size_t> choices;  ///< for each variation, which of its values
  core::Specification field;
  std::vector<core::Specification> steps;
};

/// A request whose names and values have been looked up: all combinations, those next to each other that
/// differ in the last variation alone.
struct SweepPlan {
  std::vector<Variation> variations;
  std::vector<Combination> combinations;
  Registry registry;  ///< a copy of the one that it was made with
};

/// The most combinations of one sweep.
inline constexpr std::size_t kMostCombinations = 1'000'000;

/// A key is looked for in the field and in all steps of the method; where several have it, it is written
/// "field.KEY", "NAME.KEY" or, with the number of the step from 1 on, "2.KEY".
///
/// Throws InvalidArgument if nothing varies, on keys that nothing or more than one thing has, that vary twice
/// or are given a value besides, on what make_function() and make_method() refuse of any combination, and on
/// more than kMostCombinations. Touches no file.
SweepPlan prepare(const SweepRequest& request, const Registry& registry = Registry::standard());

}  // namespace morsel::tools
