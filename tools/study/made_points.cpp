#include "morsel/tools/study/made_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/saliency.h"

namespace morsel::tools {
namespace {

using core::Index;
using morse::PointKind;
using morse::PointRank;

/// σ of the last step of the method that has one.
std::optional<double> sigma_of(const std::vector<StepOutcome>& steps) {
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    for (const auto& [key, value] : step->parameters)
      if (const double* sigma = std::get_if<double>(&value); key == "sigma" && sigma != nullptr)
        return *sigma;
  return std::nullopt;
}

core::Length salience_scale(const PointsRequest& request, const MadeField& made) {
  if (request.scale) return *request.scale;
  const std::optional<double> sigma = sigma_of(made.outcome.steps);
  return sigma ? core::Length::absolute(*sigma) : core::Length::epsilons(8);
}

/// "40 maxima", "1 saddle", "no critical point".
std::string counted(std::size_t count, PointKind kind) {
  static constexpr std::array<std::pair<const char*, const char*>, 5> kNames = {
      {{"extremum", "extrema"},
       {"maximum", "maxima"},
       {"minimum", "minima"},
       {"saddle", "saddles"},
       {"critical point", "critical points"}}};
  const auto& [one, several] = kNames[static_cast<std::size_t>(kind)];
  if (count == 0) return std::string("no ") + one;
  return core::grouped(count) + " " + (count == 1 ? one : several);
}

std::string why_fewer(PointKind kind, std::size_t count, const MadePoints& made, const MadeField& field) {
  const std::size_t found = made.chosen.points.size();
  std::string text = core::grouped(found) + " of " + core::grouped(count) + " points: ";
  for (std::size_t list = 0; list < made.candidates.size(); ++list) {
    if (list > 0) text += "; ";
    text += (list == 0 ? field.input.name : made.fill->name) + " has " +
            counted(made.candidates[list], kind) + " that " +
            (made.candidates[list] <= 1 ? "stands" : "stand") + " out at all";
    if (const std::size_t near = made.chosen.too_near[list]; near > 0)
      text += ", of which " + core::grouped(near) + (near == 1 ? " is" : " are") + " nearer than " +
              core::to_digits(made.chosen.spacing) + " along the surface to a point chosen before";
  }
  return text;
}

}  // namespace

PointsPlan prepare(const PointsRequest& request, const Registry& registry) {
  if (request.count == 0) throw core::InvalidArgument("the number of points must be at least 1, not 0");
  if (!(request.spacing.value >= 0) || !std::isfinite(request.spacing.value))
    throw core::InvalidArgument("the spacing of points must be at least 0, not " +
                                core::to_string(request.spacing));
  if (request.scale && request.rank != PointRank::salience)
    throw core::InvalidArgument("a scale is for rank=salience, not for rank=" +
                                std::string(to_string(request.rank)));
  if (request.scale && (!(request.scale->value > 0) || !std::isfinite(request.scale->value)))
    throw core::InvalidArgument("the scale of salience must be above 0, not " +
                                core::to_string(*request.scale));
  PointsPlan plan{request, std::nullopt};
  if (request.fill) plan.fill = registry.make_function(*request.fill);
  return plan;
}

std::optional<double> MadePoints::mean_percentile() const {
  if (percentiles.empty()) return std::nullopt;
  return std::accumulate(percentiles.begin(), percentiles.end(), 0.0) /
         static_cast<double>(percentiles.size());
}

std::vector<double> saliency_percentiles(const core::TriangleMesh& mesh, const core::Progress& progress) {
  if (mesh.bounding_box().diagonal() == 0) return std::vector<double>(mesh.vertex_count(), 0.5);
  morse::SaliencyOptions options;
  options.scales = morse::published_scales();
  const core::ScalarField map =
      morse::saliency(morse::mean_curvature(mesh, progress), options, progress).field;
  const std::span<const Index> order = map.order();
  std::vector<double> percentiles(order.size());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && map.value(order[last]) == map.value(order[first])) ++last;
    for (std::size_t i = first; i < last; ++i)
      percentiles[order[i]] = static_cast<double>(first + last) / 2 / static_cast<double>(order.size());
  }
  return percentiles;
}

MadePoints choose_points(const PointsPlan& plan, std::size_t count, const core::LoadedMesh& loaded,
                         const MadeField& made, const core::Progress& progress) {
  const PointsRequest& request = plan.request;
  const core::TriangleMesh& mesh = loaded.mesh;
  MadePoints result;
  std::vector<double> weight;
  if (request.rank == PointRank::salience) {
    const core::Length scale = salience_scale(request, made);
    result.scale = scale.on(mesh);
    weight = morse::mesh_salience(mesh, scale, progress);
  }
  morse::PointChooser chooser(mesh, count, request.spacing.on(mesh));
  const auto add = [&](const core::ScalarField& field) {
    const auto candidates = morse::point_candidates(field, request.kind, weight, progress);
    result.candidates.push_back(candidates.size());
    chooser.add(candidates, progress);
  };
  add(made.field());
  if (plan.fill && chooser.missing() > 0) {
    result.fill = evaluate_field(loaded, *plan.fill, progress);
    add(result.fill->field);
  }
  result.chosen = chooser.finish();
  if (result.chosen.points.size() < count) result.note = why_fewer(request.kind, count, result, made);
  return result;
}

MadePoints make_points(const PointsPlan& plan, const core::LoadedMesh& loaded, const MadeField& made,
                       const core::Progress& progress) {
  MadePoints result = choose_points(plan, plan.request.count, loaded, made, progress);
  const std::vector<double> percentiles = saliency_percentiles(loaded.mesh, progress);
  for (const morse::ChosenPoint& point : result.chosen.points)
    result.percentiles.push_back(percentiles[point.candidate.point.vertex]);
  return result;
}

}  // namespace morsel::tools
