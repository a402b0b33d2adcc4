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

/// The mean share of the vertices that a field ranks below the critical points of a run.
double mean_rank(const core::ScalarField& field, const morse::CriticalPoints& points) {
  double sum = 0;
  for (const morse::CriticalPoint& point : points.points) sum += field.rank(point.vertex);
  const auto largest = static_cast<double>(field.mesh().vertex_count()) - 1;
  return points.total() > 0 && largest > 0 ? sum / largest / static_cast<double>(points.total()) : 0;
}

}  // namespace

std::string fewer_and_where(const FigureOutcome& figure) {
  const MethodRun& all = *figure.panels[1].run;
  const MethodRun& left = *figure.panels[3].run;
  const core::ScalarField& saliency = figure.panels[2].run->made.field();
  return grouped(left.total()) + " of " + grouped(all.total()) + " critical points are left, " +
         percent(share(left.total(), all.total())) +
         " (in the paper 6.5 %). The saliency at a critical point is above that of " +
         percent(mean_rank(saliency, all.measurement.critical_points)) + " of the vertices in (b) and of " +
         percent(mean_rank(saliency, left.measurement.critical_points)) +
         " in (d), in the mean; by chance it would be 50 %.";
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
  if (figure.region) {
    const core::Index vertex = figure.model->loaded().source.numbering.input_vertex(figure.region->vertex);
    text += " (d) and (e) show the place in this view where (b) has most points more than (c) within " +
            core::to_string(figure.region->radius) + ": around vertex " + grouped(vertex) +
            ", where TPS keeps " + grouped(figure.region->first) + " and salient smoothing " +
            grouped(figure.region->second) + ".";
  }
  return text;
}

std::string levels_linked(const FigureOutcome& figure) {
  std::string text;
  for (std::size_t i = 0; i < figure.levels.size(); ++i) {
    const LevelLinks& level = figure.levels[i];
    const std::string letter = std::string(" (") + static_cast<char>('a' + i) + ")";
    text += (i == 0 ? "" : " ") + counted(level.points, "critical point", "critical points") + " and " +
            counted(level.cells, "segment", "segments") + " in" + letter;
    if (i > 0)
      text += ": " + grouped(level.kept) + " of the points stayed where they were, " + grouped(level.moved) +
              " moved, " + grouped(level.fresh) + " are new";
    text += ".";
  }
  return text;
}

}  // namespace morsel::tools::reproduce
