#include "morsel/tools/study/presets.h"

#include <algorithm>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/parameters.h"
#include "morsel/core/text/specification.h"

namespace morsel::tools {
namespace {

// Both chosen on half of the meshes of docs/sweeps-and-stability.md.
constexpr double kDiffusion = 0.47;
constexpr core::Length kScale = core::Length::root_areas(0.01);

/// With three digits, as users would write it.
std::string length_text(const core::Length& length) {
  const double value = core::parse_number(core::to_digits(length.value, 3), "length");
  return core::to_string(core::Length{value, length.unit});
}

/// Lengths of the surface alone, whatever its triangulation and pose.
Preset resampled(std::size_t points) {
  const std::string diffusion = length_text(diffusion_for(points));
  return {"resampled",
          "points that repeat where the surface has other vertices",
          "mean-curvature:estimator=diffused,scale=" + length_text(kScale) + ",diffusion=" + diffusion,
          {"conventional", "laplacian:scheme=implicit,weights=cotangent,iterations=1,time=" + diffusion,
           "tps:count=laplacian"}};
}

const Preset& find_preset(std::string_view name, const std::vector<Preset>& all) {
  std::vector<std::string> names;
  for (const Preset& preset : all) {
    if (preset.name == name) return preset;
    names.emplace_back(preset.name);
  }
  throw core::InvalidArgument("there is no preset \"" + std::string(name) + "\"" +
                              core::nearest_of(std::string(name), names, "there are"));
}

/// Without the steps whose count is another row's.
std::vector<std::string> standing_alone(const std::vector<std::string>& methods) {
  std::vector<std::string> alone;
  for (const std::string& method : methods) {
    std::vector<core::Specification> steps = core::parse_chain(method, "method");
    if (std::erase_if(steps, [](const core::Specification& step) { return named_row(step).has_value(); }) >
        0) {
      if (!steps.empty()) alone.push_back(core::to_string(steps));
    } else {
      alone.push_back(method);
    }
  }
  return alone;
}

}  // namespace

core::Length diffusion_for(std::size_t points) {
  return core::Length::root_areas(kDiffusion /
                                  std::sqrt(static_cast<double>(std::max<std::size_t>(points, 1))));
}

std::vector<Preset> presets(std::optional<std::size_t> points) {
  return {{"paper",
           "the paper's comparison, with its threshold of 0.1 % as well",
           "mean-curvature",
           {"conventional", "salient", "tps:count=salient", "tps:threshold=0.1%"}},
          {"noise",
           "points that repeat where vertices are noisy",
           "mean-curvature",
           {"conventional", "salient", "salient:preset=robust+tps:count=salient", "tps:count=salient"}},
          resampled(points.value_or(kPresetPoints)),
          {"landmarks",
           "points like those that people mark",
           "gaussian-curvature:estimator=diffused",
           {"conventional", "tps:threshold=1%"}},
          {"molecule",
           "knobs and pockets of a molecular surface",
           "mean-curvature",
           {"conventional", "salient:range=local,support=1", "tps:count=salient"}}};
}

void apply_preset(std::string_view name, ComparisonRequest& request) {
  const std::vector<Preset> all = presets(request.target);
  const Preset& preset = find_preset(name, all);
  request.field = preset.field;
  request.methods = preset.methods;
}

void apply_preset(std::string_view name, StabilityRequest& request) {
  const std::vector<Preset> all = presets(request.target);
  const Preset& preset = find_preset(name, all);
  request.fields = {preset.field};
  request.methods = standing_alone(preset.methods);
}

}  // namespace morsel::tools
