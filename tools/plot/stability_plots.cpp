#include "morsel/tools/plot/stability_plots.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace morsel::tools::plot {
namespace {

/// A perturbation of the plan, and where it is on the axis.
struct Place {
  double x = 0;
  std::size_t perturbation = 0;
};

std::string name_of(const StabilityPlan& plan, const StabilityOutcome& outcome) {
  const std::string& method = plan.chains[outcome.method].specification;
  if (plan.functions.size() == 1) return method;
  return plan.functions[outcome.field].specification + ", " + method;
}

Series line_of(const StabilityOutcome& outcome, const std::vector<Place>& places,
               Estimate (PerturbationOutcome::*quantity)() const) {
  Series series{.draw = Draw::line};
  for (const Place& place : places) {
    series.x.push_back(place.x);
    series.y.push_back((outcome.perturbations[place.perturbation].*quantity)().mean);
  }
  return series;
}

Panel panel_of(const StabilityPlan& plan, const StabilityResult& result, const std::vector<Place>& places,
               const std::optional<std::size_t>& target, bool with_chance) {
  Panel panel{.title = target ? std::to_string(*target) + " points" : "each method's own count"};
  std::size_t line = 0;
  for (const StabilityOutcome& outcome : result.outcomes) {
    if (outcome.target != target) continue;
    Series score = line_of(outcome, places, &PerturbationOutcome::f_score);
    score.name = name_of(plan, outcome);
    set_line_style(score, line++);
    if (with_chance) {
      Series chance = line_of(outcome, places, &PerturbationOutcome::chance);
      chance.color = score.color;
      chance.mark = score.mark;
      chance.dash = Dash::dotted;
      panel.series.push_back(std::move(chance));
    }
    panel.series.push_back(std::move(score));
  }
  return panel;
}

std::optional<Plot> plot_of(const StabilityPlan& plan, const StabilityResult& result,
                            std::vector<Place> places, Axis x) {
  if (places.empty()) return std::nullopt;
  std::ranges::stable_sort(places, {}, &Place::x);
  const bool with_chance = plan.functions.size() * plan.chains.size() <= std::size(kPalette);
  Plot plot;
  plot.x = std::move(x);
  plot.y = {.label = "F-score", .lower = 0, .upper = 1};
  for (const std::optional<std::size_t>& target : plan.targets)
    plot.panels.push_back(panel_of(plan, result, places, target, with_chance));
  plot.columns = plot.panels.size();
  if (plot.columns > 1) plot.width = Plot::kPageWidth;
  if (with_chance) plot.notes.emplace_back("Dotted: as many points at random vertices.");
  return plot;
}

/// The vertices of the surface whose edges are cut into `pieces`.
double subdivided_count(const core::TriangleMesh& mesh, double pieces) {
  return mesh.vertex_count() + (pieces - 1) * static_cast<double>(mesh.edge_count()) +
         (pieces - 1) * (pieces - 2) / 2 * static_cast<double>(mesh.triangle_count());
}

}  // namespace

std::optional<Plot> noise_plot(const StabilityPlan& plan, const StabilityResult& result) {
  std::vector<Place> places;
  for (std::size_t p = 0; p < plan.perturbations.size(); ++p)
    if (plan.perturbations[p].kind == PerturbationKind::noise)
      places.push_back({plan.perturbations[p].amount, p});
  return plot_of(plan, result, std::move(places), {.label = "noise", .unit = "mean edge lengths"});
}

std::optional<Plot> vertices_plot(const StabilityPlan& plan, const StabilityResult& result,
                                  const core::TriangleMesh& clean) {
  std::vector<Place> places;
  for (std::size_t p = 0; p < plan.perturbations.size(); ++p) {
    const Perturbation& perturbation = plan.perturbations[p];
    if (perturbation.kind == PerturbationKind::decimation)
      places.push_back({perturbation.amount, p});
    else if (perturbation.kind == PerturbationKind::subdivision)
      places.push_back({subdivided_count(clean, perturbation.amount) / clean.vertex_count(), p});
  }
  return plot_of(plan, result, std::move(places),
                 {.label = "vertices", .unit = "of the clean surface's", .scale = Scale::log});
}

}  // namespace morsel::tools::plot
