#include "morsel/tools/report/build_options.h"

#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/vertex_mask.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/report/points_request.h"

namespace morsel::tools {

void add_build_options(Json& request, const core::BuildOptions& build) {
  if (build.weld) request["weld"] = core::to_string(*build.weld);
  if (build.mask) request["mask"] = core::to_string(*build.mask);
}

core::BuildOptions read_build_options(const JsonView& request) {
  core::BuildOptions build{.repair = request["repair"].truth()};
  if (const auto weld = request.find("weld")) {
    build.weld = read_length(*weld);
    if (build.weld->value < 0) weld->refuse("is negative");
  }
  if (const auto mask = request.find("mask")) {
    try {
      build.mask = core::parse_vertex_values(mask->text(), "mask");
    } catch (const core::InvalidArgument& error) {
      mask->refuse(std::string("is no mask: ") + error.what());
    }
  }
  return build;
}

}  // namespace morsel::tools
