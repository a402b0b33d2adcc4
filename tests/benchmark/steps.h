#pragma once
/// The steps of a comparison but smoothing, each on its own.

#include <functional>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"

namespace morsel::benchmark {

struct Step {
  std::string name;
  double bytes_moved;  ///< that it cannot avoid: its input read once, its result written once
  std::function<std::size_t()> run;
  std::function<void()> prepare = {};  ///< what is not timed: copies of what run() takes for itself
};

/// In the order of a comparison. Refers to both.
std::vector<Step> steps(const core::TriangleMesh& mesh, const core::ScalarField& field);

}  // namespace morsel::benchmark
