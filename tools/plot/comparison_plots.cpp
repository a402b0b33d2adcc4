#include "morsel/tools/plot/comparison_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/plot/ticks.h"

namespace morsel::tools::plot {
namespace {

constexpr double kPersistenceRange = 1e-5;  // of the largest one

/// The steps' counts joined; the first count of a step is that of its input, which is the last one of the
/// step before.
std::vector<std::size_t> iteration_counts(const std::vector<StepOutcome>& steps) {
  std::vector<std::size_t> counts;
  for (const StepOutcome& step : steps)
    for (const core::IterationRecord& record : step.iterations)
      if (record.iteration > 0 || counts.empty()) counts.push_back(record.total());
  return counts.size() > 1 ? counts : std::vector<std::size_t>();
}

Series series_of(const char* name, Color color, Mark mark, const DiagramPoints& points, bool counted) {
  Series series;
  series.name = points.x.empty() ? ""
                : counted        ? std::string(name) + " (" + grouped(points.x.size()) + ")"
                                 : name;
  series.color = color;
  series.mark = mark;
  series.x = points.x;
  series.y = points.y;
  return series;
}

Panel diagram_panel(const MethodCurves& method, bool counted) {
  const std::size_t pairs = method.pairs();
  return {method.name,
          grouped(pairs) + (pairs == 1 ? " pair" : " pairs") + ", " + grouped(method.essential.x.size()) +
              " essential",
          {series_of("minimum\u2013saddle", kPalette[0], Mark::disc, method.minimum_saddle, counted),
           series_of("saddle\u2013maximum", kPalette[1], Mark::triangle, method.saddle_maximum, counted),
           series_of("saddle\u2013boundary", kPalette[2], Mark::square, method.saddle_cap, counted),
           series_of("essential", 0x000000, Mark::diamond, method.essential, counted)}};
}

/// The power of ten up to which the axes are to be linear, logarithmic beyond, because curvature and its like
/// have heavy tails: half of all values lie on a small part of their range. 0 if the axes are to be linear
/// throughout.
double linear_part(std::span<const MethodCurves> methods) {
  constexpr double kSmallPart = 0.1;
  constexpr double kDecades = 100;  // of them logarithmic
  std::vector<double> values;
  for (const MethodCurves& method : methods)
    for (const DiagramPoints* points : {&method.minimum_saddle, &method.saddle_maximum}) {
      values.insert(values.end(), points->x.begin(), points->x.end());
      values.insert(values.end(), points->y.begin(), points->y.end());
    }
  if (values.size() < 8) return 0;
  const auto quantile = [&](std::size_t quarter) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * quarter / 4);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double lowest = quantile(0), first = quantile(1), third = quantile(3), highest = quantile(4);
  const double largest = std::max(std::abs(lowest), std::abs(highest));
  if (!(third - first < kSmallPart * (highest - lowest)) || largest < 1e-200) return 0;
  // Far from 0 a logarithm does not spread the values.
  if (std::min(std::abs(lowest), std::abs(highest)) > largest / 10 && lowest * highest > 0) return 0;
  return std::pow(10, std::floor(std::log10(largest / kDecades)));
}

/// Of lines that may run along one another (a cancelled field keeps all other pairs): each shows the ones
/// below it.
Dash dash_of(std::size_t line) {
  constexpr Dash kDashes[] = {Dash::solid, Dash::dashed, Dash::dotted, Dash::dash_dot};
  return kDashes[(line + line / std::size(kPalette)) % std::size(kDashes)];
}

Plot diagrams(std::span<const MethodCurves> methods, const std::string& field) {
  Plot plot;
  plot.x.label = field + " at birth";
  plot.y.label = field + " at death";
  plot.diagonal = true;
  if (const double linear = linear_part(methods); linear > 0) {
    for (Axis* axis : {&plot.x, &plot.y}) {
      axis->scale = Scale::symmetric;
      axis->linear = linear;
    }
    const int power = static_cast<int>(std::lround(std::log10(linear)));
    const std::string number = power == 0    ? "1"
                               : power == 1  ? "10"
                               : power == -1 ? "0.1"
                                             : power_of_ten(power);
    plot.notes = {"Both axes are linear to about \u00b1" + number + ", logarithmic beyond."};
  }
  return plot;
}

}  // namespace

MethodCurves curves_of(const MethodOutcome& outcome) {
  const persistence::Diagram& diagram = outcome.measurement.diagram;
  const core::ScalarField& field = outcome.field;
  MethodCurves curves;
  curves.name = outcome.specification;
  const auto add = [](DiagramPoints& points, double birth, double death) {
    points.x.push_back(birth);
    points.y.push_back(death);
  };
  for (const persistence::PersistencePair& pair : diagram.pairs)
    add(pair.kind == persistence::PairKind::minimum_saddle   ? curves.minimum_saddle
        : pair.kind == persistence::PairKind::saddle_maximum ? curves.saddle_maximum
                                                             : curves.saddle_cap,
        pair.birth, pair.death);
  for (const persistence::EssentialExtrema& extrema : diagram.essential_extrema) {
    add(curves.essential, field.value(extrema.minimum), persistence::kInfinite);
    if (!extrema.top_is_cap) add(curves.essential, field.value(extrema.top), persistence::kInfinite);
  }
  for (const persistence::EssentialSaddle& saddle : diagram.essential_saddles)
    for (core::Index i = 0; i < saddle.count; ++i)
      add(curves.essential, field.value(saddle.vertex), persistence::kInfinite);
  for (const persistence::PersistencePair& pair : diagram.finite_pairs())
    curves.persistences.push_back(pair.persistence());
  curves.counts = iteration_counts(outcome.steps);
  return curves;
}

Plot diagram_plot(const MethodCurves& method, const std::string& field) {
  Plot plot = diagrams({&method, 1}, field);
  plot.panels = {diagram_panel(method, true)};
  return plot;
}

Plot diagram_sheet(const std::vector<MethodCurves>& methods, const std::string& field) {
  Plot plot = diagrams(methods, field);
  plot.width = Plot::kPageWidth;
  plot.columns = methods.size() == 4 ? 2 : methods.size() <= 6 ? 3 : 4;
  for (const MethodCurves& method : methods) plot.panels.push_back(diagram_panel(method, false));
  return plot;
}

Plot persistence_plot(const std::vector<MethodCurves>& methods, const std::string& field) {
  Plot plot;
  plot.x = {.label = "persistence of " + field, .scale = Scale::log};
  plot.y = {.label = "pairs above that persistence", .scale = Scale::log};
  double largest = 0;
  for (const MethodCurves& method : methods)
    if (!method.persistences.empty()) largest = std::max(largest, method.persistences.back());
  const double least = kPersistenceRange * largest;
  if (least > 0) plot.x.lower = least;
  plot.panels.emplace_back();
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::vector<double>& persistences = methods[m].persistences;
    Series series;
    series.name = methods[m].name;
    series.draw = Draw::steps;
    set_line_style(series, m);
    series.dash = dash_of(m);
    const auto first = std::upper_bound(persistences.begin(), persistences.end(), least);
    auto left =
        static_cast<std::size_t>(persistences.end() - first);  // pairs of at least the next persistence
    const auto point = [&](double x) {
      series.x.push_back(x);
      series.y.push_back(static_cast<double>(left));
    };
    if (left > 0 && least > 0) {
      point(std::min(least, *first));
      for (auto p = first; left > 1; ++p) {
        --left;
        if (*p < *(p + 1)) point(*p);
      }
      point(persistences.back());
    }
    plot.panels.front().series.push_back(std::move(series));
  }
  return plot;
}

Plot iteration_plot(const std::vector<MethodCurves>& methods) {
  Plot plot;
  plot.x = {.label = "iteration"};
  plot.y = {.label = "critical points", .scale = Scale::log};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (methods[m].counts.empty()) continue;
    Series series;
    series.name = methods[m].name;
    series.draw = Draw::line;
    set_line_style(series, m);  // that of the method in the other plots
    for (std::size_t i = 0; i < methods[m].counts.size(); ++i) {
      series.x.push_back(static_cast<double>(i));
      series.y.push_back(static_cast<double>(methods[m].counts[i]));
    }
    if (plot.panels.empty()) plot.panels.emplace_back();
    plot.panels.front().series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace morsel::tools::plot
