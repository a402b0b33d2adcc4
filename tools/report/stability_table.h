#pragma once
/// The result of a stability study as tables for people.

#include <string>

#include "morsel/tools/study/stability.h"

namespace morsel::tools {

/// For each count (the methods' own, the wanted one) the clean points, then a row for each perturbation and
/// method.
std::string stability_table(const StabilityPlan& plan, const StabilityResult& result);

}  // namespace morsel::tools
