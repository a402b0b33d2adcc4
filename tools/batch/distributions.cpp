#include "morsel/tools/batch/distributions.h"

#include <algorithm>
#include <cmath>

namespace morsel::tools::batch {
namespace {

constexpr int kBinsADecade = 4;

plot::Series named(const MethodTotals& method, std::size_t i, plot::Draw draw) {
  plot::Series series;
  series.name = method.name;
  plot::set_line_style(series, i);
  series.draw = draw;
  return series;
}

plot::Plot plot_of(std::string title, plot::Axis x, plot::Axis y) {
  plot::Plot plot;
  plot.title = std::move(title);
  plot.x = std::move(x);
  plot.y = std::move(y);
  plot.panels.emplace_back();
  return plot;
}

plot::Axis points_axis() { return {"critical points", "", plot::Scale::log}; }

}  // namespace

std::vector<double> logarithmic_bins(const std::vector<double>& values) {
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  const auto edge = [](int i) { return std::pow(10., static_cast<double>(i) / kBinsADecade); };
  int first = static_cast<int>(std::floor(std::log10(*smallest) * kBinsADecade));
  while (edge(first) > *smallest) --first;  // logarithms are rounded
  std::vector<double> edges;
  for (int i = first; edges.empty() || edges.back() <= *largest; ++i) edges.push_back(edge(i));
  return edges;
}

plot::Plot histogram(const std::vector<MethodTotals>& methods) {
  plot::Axis meshes{"meshes"};
  meshes.lower = 0;
  plot::Plot plot = plot_of("Critical points a mesh", points_axis(), meshes);
  std::vector<double> all;
  for (const MethodTotals& method : methods)
    all.insert(all.end(), method.totals.begin(), method.totals.end());
  const std::vector<double> edges = logarithmic_bins(all);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    plot::Series series = named(methods[i], i, plot::Draw::steps);
    series.x = edges;
    series.y.assign(edges.size(), 0);  // the last ends the line at 0
    for (const double total : methods[i].totals)
      ++series.y[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), total) -
                                          edges.begin() - 1)];
    plot.panels.front().series.push_back(std::move(series));
  }
  return plot;
}

plot::Plot cumulative(const std::vector<MethodTotals>& methods) {
  plot::Axis share{"meshes with no more", "%"};
  share.lower = 0;
  share.upper = 100;
  plot::Plot plot = plot_of("Cumulative distribution", points_axis(), share);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    plot::Series series = named(methods[i], i, plot::Draw::steps);
    std::vector<double> totals = methods[i].totals;
    std::sort(totals.begin(), totals.end());
    for (std::size_t k = 0; k < totals.size(); ++k) {
      if (k == 0) {
        series.x.push_back(totals[0]);
        series.y.push_back(0);
      }
      series.x.push_back(totals[k]);
      series.y.push_back(100. * static_cast<double>(k + 1) / static_cast<double>(totals.size()));
    }
    plot.panels.front().series.push_back(std::move(series));
  }
  return plot;
}

plot::Plot against_size(const std::vector<MethodTotals>& methods) {
  plot::Plot plot =
      plot_of("Critical points against size", {"vertices", "", plot::Scale::log}, points_axis());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    plot::Series series = named(methods[i], i, plot::Draw::marks);
    constexpr plot::Mark kMarks[] = {plot::Mark::disc, plot::Mark::square, plot::Mark::triangle,
                                     plot::Mark::diamond};
    series.mark = kMarks[i % std::size(kMarks)];
    series.x = methods[i].vertices;
    series.y = methods[i].totals;
    plot.panels.front().series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace morsel::tools::batch
