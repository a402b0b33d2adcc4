#include "morsel/tools/commands/points_options.h"

#include <limits>

namespace morsel::tools {

PointsRequest ChoiceOptions::request() const {
  PointsRequest request = points;
  request.spacing = core::parse_length(spacing, "--spacing");
  if (fill != kNoFill) request.fill = fill;
  if (!scale.empty()) request.scale = core::parse_length(scale, "--salience-scale");
  return request;
}

std::optional<PointsRequest> PointsOptions::request() const {
  if (!count) return std::nullopt;
  PointsRequest request = choice.request();
  request.count = *count;
  return request;
}

void add_choice_options(Command& command, ChoiceOptions& choice) {
  command.choice("--kind", choice.points.kind, morse::kPointKinds, "extrema, maxima, minima, saddles or all")
      .value("KIND");
  command
      .choice("--rank", choice.points.rank, morse::kPointRanks, "What comes first: persistence or salience")
      .value("RANK")
      .in_detail(
          "persistence: of essential points, which have none, the extent of the field on their component; "
          "salience: persistence times the mesh saliency of the surface there, counted by areas and "
          "smoothed, 1 on average");
  command.text("--spacing", choice.spacing, "The least distance of two points along the surface")
      .value("LENGTH")
      .in_detail(
          "Points are taken by rank; what is nearer to one that was taken before is passed over. 0: no two "
          "at one vertex. Distances are those of paths along edges and straight across two triangles: not "
          "shorter than geodesic ones, a few percent longer");
  command.text("--fill", choice.fill, "A Morse function that fills up, or none")
      .is_function()
      .in_detail(
          "Where the field has too few points, its points come after these, by their own rank and apart from "
          "those");
  command.text("--salience-scale", choice.scale, "How far salience is smoothed")
      .value("LENGTH")
      .shows_default("the method's sigma, or 8eps");
}

void add_points_options(Command& command, PointsOptions& options, const std::string& told_by) {
  if (told_by.empty()) command.begin_group("Chosen points");
  Option& count = command
                      .number("--points", options.count,
                              "Choose K critical points; where there are fewer, the reason is printed")
                      .between(1, std::numeric_limits<double>::infinity())
                      .value("K");
  if (options.count) count.shows_default(std::to_string(*options.count));
  add_choice_options(command, options.choice);
  command
      .flag("--percentiles", options.choice.points.percentiles,
            "Measure how salient the surface is at each point")
      .in_detail(
          "The share of all vertices with less mesh saliency than the point's: half on average for vertices "
          "taken at random. It takes as long as the method saliency, once a mesh");
  for (const char* name : {"--kind", "--rank", "--spacing", "--fill", "--salience-scale", "--percentiles"}) {
    Option& option = command.option(name);
    option.told_by = told_by;
    if (!options.count) option.needs("--points");
  }
}

}  // namespace morsel::tools
