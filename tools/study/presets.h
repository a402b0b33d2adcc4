#pragma once
/// Fields and methods that go together, by what they are for.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/length.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/stability.h"

namespace morsel::tools {

struct Preset {
  std::string_view name;
  std::string_view purpose;  ///< a line for help
  std::string field;
  std::vector<std::string> methods;  ///< of a comparison: they may refer to one another
};

/// The number of points that `resampled` is for where none is wanted.
inline constexpr std::size_t kPresetPoints = 20;

/// How far `resampled` diffuses a surface on which `points` critical points are to be left: 0.47/√points of
/// the root of its area, about half the side of a square that has a point's share of the surface. More leaves
/// too few points on smooth surfaces, less leaves many that the choice among them is not the same again.
core::Length diffusion_for(std::size_t points);

/// paper, noise, resampled, landmarks, molecule. The lengths of `resampled` are chosen for `points`.
std::vector<Preset> presets(std::optional<std::size_t> points = {});

/// Sets field and methods, for the target that the request has. Throws InvalidArgument if there is no preset
/// of that name.
void apply_preset(std::string_view name, ComparisonRequest& request);

/// Sets the field, and the methods without steps that end with as many points as another row: a target does
/// that here.
void apply_preset(std::string_view name, StabilityRequest& request);

}  // namespace morsel::tools
