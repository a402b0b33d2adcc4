#include "morsel/tools/report/points_request.h"

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools {
namespace {

/// The one of these values that the text names.
template <class Values>
auto named(const JsonView& text, const Values& values) {
  const auto found =
      std::ranges::find_if(values, [&](auto value) { return to_string(value) == text.text(); });
  if (found == values.end()) text.refuse("has another value than this version knows");
  return *found;
}

core::Length length(const JsonView& text) {
  try {
    return core::parse_length(text.text(), "it");
  } catch (const core::InvalidArgument&) {
    text.refuse("is not a length");
  }
}

}  // namespace

Json request_section(const PointsRequest& points) {
  Json asked = {{"count", points.count},
                {"kind", to_string(points.kind)},
                {"rank", to_string(points.rank)},
                {"spacing", core::to_string(points.spacing)},
                {"percentiles", points.percentiles}};
  if (points.fill) asked["fill"] = *points.fill;
  if (points.scale) asked["scale"] = core::to_string(*points.scale);
  return asked;
}

PointsRequest read_points_request(const JsonView& section) {
  PointsRequest points;
  points.count = section["count"].count();
  points.kind = named(section["kind"], morse::kPointKinds);
  points.rank = named(section["rank"], morse::kPointRanks);
  points.spacing = length(section["spacing"]);
  points.percentiles = section["percentiles"].truth();
  if (const auto fill = section.find("fill")) points.fill = fill->text();
  if (const auto scale = section.find("scale")) points.scale = length(*scale);
  return points;
}

}  // namespace morsel::tools
