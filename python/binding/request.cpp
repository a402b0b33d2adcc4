#include "morsel/python/binding/request.h"

namespace morsel::python {

core::BuildOptions build_options(bool repair, const std::optional<std::string>& weld) {
  core::BuildOptions build{.repair = repair};
  if (!weld) return build;
  build.weld = core::parse_length(*weld, "weld");
  if (build.weld->value < 0) throw core::InvalidArgument("weld must not be negative");
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
