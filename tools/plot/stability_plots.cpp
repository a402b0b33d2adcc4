#include "morsel/tools/plot/stability_plots.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
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

/// From left to right, those that a line goes through; another line with a gap before it follows.
using Places = std::vector<std::vector<Place>>;

constexpr std::size_t kLongestField = 24;     // whose text is in the legend
constexpr std::size_t kLongestInColumn = 40;  // whose entry in the legend a column has room for

/// The fields' names in the legend: their texts, or numbers that notes explain.
class FieldNames {
 public:
  explicit FieldNames(const StabilityPlan& plan) : plan_(plan) {
    const auto is_long = [](const NamedFunction& f) { return f.specification.size() > kLongestField; };
    numbered_ = plan.functions.size() > 1 && std::ranges::any_of(plan.functions, is_long);
  }

  std::string of(const StabilityOutcome& outcome) const {
    const std::string& method = plan_.chains[outcome.method].specification;
    if (plan_.functions.size() == 1) return method;
    return (numbered_ ? numbered(outcome.field) : plan_.functions[outcome.field].specification) + ", " +
           method;
  }

  void add_notes(std::vector<std::string>& notes) const {
    if (!numbered_) return;
    for (std::size_t field = 0; field < plan_.functions.size(); ++field)
      notes.push_back(numbered(field) + ": " + plan_.functions[field].specification);
  }

 private:
  static std::string numbered(std::size_t field) { return "field " + std::to_string(field + 1); }

  const StabilityPlan& plan_;
  bool numbered_ = false;
};

/// The i-th line of the plot, if it is one: a single place has marks alone, by which lines can be told apart
/// that have a colour in common.
Series styled(std::size_t i, bool is_line) {
  constexpr Mark kMarks[] = {Mark::disc, Mark::square, Mark::diamond};
  Series series{.draw = is_line ? Draw::line : Draw::marks};
  set_line_style(series, i);
  if (!is_line) series.mark = kMarks[i / std::size(kPalette) % std::size(kMarks)];
  return series;
}

Series through(const std::vector<Place>& places, const StabilityOutcome& outcome,
               Estimate (PerturbationOutcome::*quantity)() const, Series series) {
  for (const Place& place : places) {
    series.x.push_back(place.x);
    series.y.push_back((outcome.perturbations[place.perturbation].*quantity)().mean);
  }
  return series;
}

class StabilityPlot {
 public:
  StabilityPlot(const StabilityPlan& plan, const StabilityResult& result, Places places)
      : plan_(plan), result_(result), names_(plan), places_(std::move(places)) {
    for (std::vector<Place>& run : places_) std::ranges::stable_sort(run, {}, &Place::x);
    std::erase_if(places_, [](const std::vector<Place>& run) { return run.empty(); });
    has_lines_ = std::ranges::any_of(places_, [](const std::vector<Place>& run) { return run.size() > 1; });
    has_chance_ = plan.functions.size() * plan.chains.size() <= std::size(kPalette);
  }

  std::optional<Plot> over(Axis x) const {
    if (places_.empty()) return std::nullopt;
    Plot plot;
    plot.x = std::move(x);
    plot.y = {.label = "F-score", .lower = 0, .upper = 1};
    for (const std::optional<std::size_t>& target : plan_.targets) plot.panels.push_back(panel(target));
    plot.columns = plot.panels.size();
    if (plot.columns > 1 || has_long_names(plot.panels.front())) plot.width = Plot::kPageWidth;
    if (has_chance_) plot.notes.emplace_back("Dotted, triangles: as many points at random vertices.");
    names_.add_notes(plot.notes);
    return plot;
  }

 private:
  Panel panel(const std::optional<std::size_t>& target) const {
    Panel panel{.title = target ? std::to_string(*target) + " points" : "each method's own count"};
    std::size_t line = 0;
    for (const StabilityOutcome& outcome : result_.outcomes)
      if (outcome.target == target) add(panel, outcome, line++);
    return panel;
  }

  void add(Panel& panel, const StabilityOutcome& outcome, std::size_t line) const {
    Series score = styled(line, has_lines_);
    Series chance = score;
    score.name = names_.of(outcome);
    chance.dash = Dash::dotted;
    chance.mark = Mark::triangle;
    for (const std::vector<Place>& run : places_) {
      if (has_chance_) panel.series.push_back(through(run, outcome, &PerturbationOutcome::chance, chance));
      panel.series.push_back(through(run, outcome, &PerturbationOutcome::f_score, score));
    }
  }

  static bool has_long_names(const Panel& panel) {
    return std::ranges::any_of(panel.series,
                               [](const Series& series) { return series.name.size() > kLongestInColumn; });
  }

  const StabilityPlan& plan_;
  const StabilityResult& result_;
  FieldNames names_;
  Places places_;
  bool has_lines_ = false;
  bool has_chance_ = false;
};

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
  return StabilityPlot(plan, result, {std::move(places)})
      .over({.label = "noise", .unit = "mean edge lengths"});
}

std::optional<Plot> vertices_plot(const StabilityPlan& plan, const StabilityResult& result,
                                  const core::TriangleMesh& clean) {
  std::vector<Place> fewer;
  std::vector<Place> more;
  for (std::size_t p = 0; p < plan.perturbations.size(); ++p) {
    const Perturbation& perturbation = plan.perturbations[p];
    if (perturbation.kind == PerturbationKind::decimation)
      fewer.push_back({perturbation.amount, p});
    else if (perturbation.kind == PerturbationKind::subdivision)
      more.push_back({subdivided_count(clean, perturbation.amount) / clean.vertex_count(), p});
  }
  return StabilityPlot(plan, result, {std::move(fewer), std::move(more)})
      .over({.label = "vertices", .unit = "share of the clean surface's", .scale = Scale::log});
}

}  // namespace morsel::tools::plot
