#include "morsel/tools/reproduce/findings.h"

#include <cmath>

#include "morsel/core/text/numbers.h"
#include "morsel/tools/formats/text_table.h"

namespace morsel::tools::reproduce {
namespace {

std::string percent(double share) {
  const double value = 100 * share;
  return core::shortest(value < 10 ? std::round(10 * value) / 10 : std::round(value)) + " %";
}

std::string counted(std::size_t number, const char* one, const char* many) {
  return grouped(number) + " " + (number == 1 ? one : many);
}

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// The mean saliency percentile of a run's extrema.
std::string mean_percentile_text(Model& model, const MethodRun& run) {
  const std::optional<double> mean = model.percentile(extrema_of(run));
  return mean ? core::to_decimals(*mean, 2) : "-";
}

/// "a maximum", "regular"
std::string type_at(const MethodRun& run, core::Index vertex) {
  for (const morse::CriticalPoint& point : run.measurement.critical_points.points)
    if (point.vertex == vertex) return "a " + std::string(to_string(point.type));
  return "regular";
}

/// "(a)"
std::string panel_letter(std::size_t panel) {
  return std::string("(") + static_cast<char>('a' + panel) + ")";
}

}  // namespace

std::string fewer_and_where(const FigureOutcome& figure) {
  const MethodRun& all = *figure.panels[1].run;
  const MethodRun& left = *figure.panels[3].run;
  return grouped(left.total()) + " of " + grouped(all.total()) + " critical points are left, " +
         percent(share(left.total(), all.total())) +
         " (in the paper 6.5 %). The mean saliency percentile of the extrema is " +
         mean_percentile_text(*figure.model, all) + " in (b) and " +
         mean_percentile_text(*figure.model, left) + " in (d); by chance it would be 0.50.";
}

std::string simpler_complex(const FigureOutcome& figure) {
  std::string text;
  for (std::size_t i = 0; i < 2; ++i) {
    const Measurement& m = figure.panels[i].run->measurement;
    text += (i == 0 ? "(a) has " : "; (b) has ") + counted(m.complex.arc_count(), "arc", "arcs") + " and " +
            counted(m.cells, "cell", "cells");
  }
  return text + ".";
}

std::string region_compared(const FigureOutcome& figure) {
  const MethodRun& all = *figure.panels[0].run;
  const MethodRun& threshold = figure.model->run("tps:threshold=0.1%");
  std::string text =
      "Cancelling pairs of at most 0.1 % of the curvature's range, as the paper does, leaves " +
      grouped(threshold.total()) + " of the " + grouped(all.total()) +
      " critical points of this mesh, so (b) cancels as many pairs as leave " +
      grouped(figure.panels[1].run->total()) + ", for " + grouped(figure.panels[2].run->total()) + " in (c).";
  if (!figure.region) return text;
  const ComparedRegion& region = *figure.region;
  const core::Index vertex = figure.model->loaded().source.numbering.input_vertex(region.vertex);
  text +=
      " (d) and (e) show the place in this view with most points of (a), " + grouped(region.all) +
      " within " + core::to_string(region.radius) + ": around vertex " + grouped(vertex) +
      ", where TPS keeps " + grouped(region.first) + " and salient smoothing " + grouped(region.second) +
      ". Of all places in this view, TPS keeps more points than salient smoothing within that distance at " +
      percent(share(region.more_of_first, region.places)) + ", fewer at " +
      percent(share(region.more_of_second, region.places)) + ".";
  return text;
}

std::string levels_linked(const FigureOutcome& figure) {
  std::string text;
  for (std::size_t i = 0; i < figure.levels.size(); ++i) {
    const LevelLinks& level = figure.levels[i];
    text += (i == 0 ? "" : " ") + counted(level.points, "critical point", "critical points") + " and " +
            counted(level.cells, "segment", "segments") + " in " + panel_letter(i);
    if (i > 0)
      text += ": " + grouped(level.kept) + " of the points stayed where they were, " + grouped(level.moved) +
              " moved, " + grouped(level.fresh) + " are new";
    text += ".";
  }
  return text;
}

std::string types_of_ends(const FigureOutcome& figure) {
  const core::ScalarField& field = figure.panels.front().run->made.field();
  const core::Index highest = field.order().back();
  const core::Index lowest = field.order().front();
  std::string text;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const MethodRun& run = *figure.panels[i].run;
    text += (i == 0 ? "" : " ") + std::string("In ") + panel_letter(i) +
            " the highest vertex of the torus is " + type_at(run, highest) + " and the lowest " +
            type_at(run, lowest) + ", of " + counted(run.total(), "critical point", "critical points") + ".";
  }
  return text;
}

}  // namespace morsel::tools::reproduce
