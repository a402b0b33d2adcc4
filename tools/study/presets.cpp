#include "morsel/tools/study/presets.h"

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"

namespace morsel::tools {

std::span<const Preset> presets() {
  static const std::vector<Preset> all = {
      {"paper",
       "the paper's comparison, with its threshold of 0.1 % as well",
       "mean-curvature",
       {"conventional", "salient", "tps:count=salient", "tps:threshold=0.1%"}},
      {"noise",
       "points that repeat where vertices are noisy",
       "mean-curvature",
       {"conventional", "salient", "salient:preset=robust+tps:count=salient", "tps:count=salient"}},
      {"resampled",
       "points that repeat where the surface has other vertices",
       "mean-curvature:estimator=diffused",
       {"conventional", "laplacian:scheme=implicit,weights=cotangent,iterations=2,time=0.048rootarea",
        "tps:count=laplacian"}},
      {"landmarks",
       "points like those that people mark",
       "gaussian-curvature:estimator=diffused",
       {"conventional", "tps:threshold=1%"}},
      {"molecule",
       "knobs and pockets of a molecular surface",
       "mean-curvature",
       {"conventional", "salient:range=local,support=1", "tps:count=salient"}}};
  return all;
}

void apply_preset(std::string_view name, ComparisonRequest& request) {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) {
    names.emplace_back(preset.name);
    if (preset.name != name) continue;
    request.field = preset.field;
    request.methods = preset.methods;
    return;
  }
  throw core::InvalidArgument("there is no preset \"" + std::string(name) + "\"" +
                              core::nearest_of(std::string(name), names, "there are"));
}

}  // namespace morsel::tools
