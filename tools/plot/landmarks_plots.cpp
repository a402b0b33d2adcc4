#include "morsel/tools/plot/landmarks_plots.h"

#include <algorithm>
#include <string>
#include <utility>

namespace morsel::tools::plot {
namespace {

std::string unit_name(core::LengthUnit unit) {
  switch (unit) {
    case core::LengthUnit::epsilon:
      return "eps";
    case core::LengthUnit::edge:
      return "mean edges";
    case core::LengthUnit::percent:
      return "% of the diagonal";
    case core::LengthUnit::root_area:
      return "roots of the area";
    default:
      return "";
  }
}

Series line_of(const LandmarksPlan& plan, std::size_t row) {
  Series series{.name = plan.name_of(row), .draw = Draw::line};
  set_line_style(series, row);
  return series;
}

}  // namespace

Plot landmark_errors(const LandmarksPlan& plan, const std::vector<LandmarksSummary>& summaries) {
  Plot plot;
  plot.x = {.label = "radius", .unit = unit_name(plan.request.largest_radius.unit)};
  plot.y = {.label = "error", .lower = 0, .upper = 1};
  plot.columns = 2;
  plot.width = Plot::kPageWidth;
  using Curve = std::vector<double> LandmarksSummary::*;
  const std::pair<const char*, Curve> errors[] = {
      {"false negatives", &LandmarksSummary::false_negatives_within},
      {"false positives", &LandmarksSummary::false_positives_within}};
  for (const auto& [title, curve] : errors) {
    Panel& panel = plot.panels.emplace_back(Panel{.title = title});
    for (std::size_t row = 0; row < summaries.size(); ++row) {
      Series series = line_of(plan, row);
      for (std::size_t step = 0; step <= LandmarksPlan::kCurveSteps; ++step)
        series.x.push_back(plan.curve_radius(step));
      series.y = summaries[row].*curve;
      panel.series.push_back(std::move(series));
    }
  }
  return plot;
}

Plot landmark_scores(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes) {
  Plot plot;
  plot.x = {.label = "F-score", .lower = 0, .upper = 1};
  plot.y = {.label = "share of the meshes with at least that", .lower = 0, .upper = 1};
  Panel& panel = plot.panels.emplace_back();
  for (std::size_t row = 0; row < plan.rows(); ++row) {
    std::vector<double> scores;
    for (const LandmarksOnMesh& mesh : meshes)
      scores.push_back(mesh.rows[row].mean([](const MarkScore& score) { return score.f_score(); }));
    std::ranges::sort(scores);
    Series series = line_of(plan, row);
    series.draw = Draw::steps;
    const auto add = [&](double x, std::size_t below) {
      series.x.push_back(x);
      series.y.push_back(1 - static_cast<double>(below) / static_cast<double>(scores.size()));
    };
    add(0, 0);
    for (std::size_t i = 0; i < scores.size(); ++i) add(scores[i], i + 1);  // from there on it is one less
    add(1, scores.size());
    panel.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace morsel::tools::plot
