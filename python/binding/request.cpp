#include "morsel/python/binding/request.h"

#include "morsel/core/io/vertex_mask.h"

namespace morsel::python {

core::BuildOptions build_options(const BuildTexts& texts) {
  core::BuildOptions build{.repair = texts.repair};
  if (texts.weld) {
    build.weld = core::parse_length(*texts.weld, "weld");
    if (build.weld->value < 0) throw core::InvalidArgument("weld must not be negative");
  }
  if (texts.mask) build.mask = core::parse_vertex_values(*texts.mask, "mask");
  return build;
}

tools::PointsRequest points_request(const py::dict& given) {
  tools::PointsRequest request;
  const RequestReader reader(given);
  reader.take("count", request.count);
  reader.choose("kind", request.kind, morse::kPointKinds);
  reader.choose("rank", request.rank, morse::kPointRanks);
  reader.take_length("spacing", request.spacing);
  reader.take("fill", request.fill);
  reader.take_length("scale", request.scale);
  reader.take("percentiles", request.percentiles);
  return request;
}

}  // namespace morsel::python
