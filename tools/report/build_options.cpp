#include "morsel/tools/report/build_options.h"

#include "morsel/core/text/parameters.h"
#include "morsel/tools/report/points_request.h"

namespace morsel::tools {

void add_welding(Json& request, const core::BuildOptions& build) {
  if (build.weld) request["weld"] = core::to_string(*build.weld);
}

core::BuildOptions read_build_options(const JsonView& request) {
  core::BuildOptions build{.repair = request["repair"].truth()};
  if (const auto weld = request.find("weld")) {
    build.weld = read_length(*weld);
    if (build.weld->value < 0) weld->refuse("is negative");
  }
  return build;
}

}  // namespace morsel::tools
