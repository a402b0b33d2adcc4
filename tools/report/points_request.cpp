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

}  // namespace

core::Length read_length(const JsonView& text) {
  try {
    return core::parse_length(text.text(), "it");
  } catch (const core::InvalidArgument&) {
    text.refuse("is not a length");
  }
}

Json choice_section(const PointsRequest& points) {
  Json section = {{"kind", to_string(points.kind)},
                  {"rank", to_string(points.rank)},
                  {"spacing", core::to_string(points.spacing)}};
  if (points.fill) section["fill"] = *points.fill;
  if (points.scale) section["scale"] = core::to_string(*points.scale);
  return section;
}

PointsRequest read_choice(const JsonView& section) {
  PointsRequest points;
  points.kind = named(section["kind"], morse::kPointKinds);
  points.rank = named(section["rank"], morse::kPointRanks);
  points.spacing = read_length(section["spacing"]);
  if (const auto fill = section.find("fill")) points.fill = fill->text();
  if (const auto scale = section.find("scale")) points.scale = read_length(*scale);
  return points;
}

Json request_section(const PointsRequest& points) {
  Json asked = choice_section(points);
  asked["count"] = points.count;
  asked["percentiles"] = points.percentiles;
  return asked;
}

PointsRequest read_points_request(const JsonView& section) {
  PointsRequest points = read_choice(section);
  points.count = section["count"].count();
  points.percentiles = section["percentiles"].truth();
  return points;
}

}  // namespace morsel::tools
