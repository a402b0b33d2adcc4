#pragma once
/// Fields and methods that go together, by what they are for.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

struct Preset {
  std::string_view name;
  std::string_view purpose;  ///< a line for help
  std::string_view field;
  std::vector<std::string> methods;
};

/// paper, noise, resampled, landmarks, molecule.
std::span<const Preset> presets();

/// Sets field and methods. Throws InvalidArgument if there is no preset of that name.
void apply_preset(std::string_view name, ComparisonRequest& request);

}  // namespace morsel::tools
