#include "morsel/tools/study/made_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/saliency.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {
namespace {

using core::Index;
using morse::PointKind;
using morse::PointRank;

/// σ of the last step of the method that has one.
std::optional<double> sigma_of(const std::vector<StepOutcome>& steps) {
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    if (step->sigma) return step->sigma;
  return std::nullopt;
}

core::Length salience_scale(const PointsRequest& request, const PointsField& from) {
  if (request.scale) return *request.scale;
  const std::optional<double> sigma = sigma_of(from.steps);
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

std::string why_fewer(PointKind kind, std::size_t count, const MadePoints& made, const std::string& name) {
  const std::size_t found = made.chosen.points.size();
  std::string text = core::grouped(found) + " of " + core::grouped(count) + " points: ";
  for (std::size_t list = 0; list < made.candidates.size(); ++list) {
    if (list > 0) text += "; ";
    text += (list == 0 ? name : made.fill->name) + " has " + counted(made.candidates[list], kind) + " that " +
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
  if (request.fill) plan.fill = registry.make_function(*request.fill, "the Morse function that fills up");
  return plan;
}

std::optional<double> MadePoints::percentile(std::size_t i) const {
  return has_percentiles ? std::optional(percentiles[i]) : std::nullopt;
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

const std::vector<double>& PointMaker::salience_at(core::Length scale, const core::Progress& progress) {
  std::vector<double>& weight = weights_[scale.on(loaded_.mesh)];
  if (weight.empty()) {
    if (!salience_) salience_.emplace(loaded_.mesh, progress);
    weight = salience_->at(scale, progress);
  }
  return weight;
}

MadePoints PointMaker::make(const PointsField& from, std::size_t count, const core::Progress& progress) {
  const PointsRequest& request = plan_.request;
  const core::TriangleMesh& mesh = loaded_.mesh;
  MadePoints result;
  std::span<const double> weight;
  if (request.rank == PointRank::salience) {
    const core::Length scale = salience_scale(request, from);
    result.scale = scale.on(mesh);
    weight = salience_at(scale, progress);
  }
  morse::PointChooser chooser(mesh, count, request.spacing.on(mesh));
  const auto add = [&](const core::ScalarField& field) {
    const auto candidates = morse::point_candidates(field, request.kind, weight, progress);
    result.candidates.push_back(candidates.size());
    chooser.add(candidates, progress);
  };
  add(from.field);
  if (plan_.fill && chooser.missing() > 0) {
    if (!fill_) fill_ = evaluate_field(loaded_, *plan_.fill, progress);
    result.fill = fill_;
    add(fill_->field);
  }
  result.chosen = chooser.finish();
  if (result.chosen.points.size() < count) result.note = why_fewer(request.kind, count, result, from.name);
  for (const morse::ChosenPoint& point : result.chosen.points)
    result.places.push_back(point.candidate.point.vertex);
  result.has_percentiles = request.percentiles;
  if (!request.percentiles) return result;
  if (percentiles_.empty()) percentiles_ = saliency_percentiles(mesh, progress);
  for (const core::Index v : result.places) result.percentiles.push_back(percentiles_[v]);
  return result;
}

MadePoints make_points(const PointsPlan& plan, const core::LoadedMesh& loaded, const MadeField& made,
                       const core::Progress& progress) {
  return PointMaker(plan, loaded).make(made.for_points(), progress);
}

}  // namespace morsel::tools
