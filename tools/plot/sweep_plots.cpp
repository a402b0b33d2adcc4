#include "morsel/tools/plot/sweep_plots.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "morsel/tools/formats/text_table.h"

namespace morsel::tools::plot {
namespace {

constexpr std::size_t kMostLines = 14;
constexpr double kWideSpread = 30;

using Count = std::size_t (*)(const morse::CriticalPoints&);

std::size_t total_of(const morse::CriticalPoints& points) { return points.total(); }

double count_of(const SweepRow& row, Count count) { return static_cast<double>(count(row.critical_points)); }

/// The positions of a variation's values, and the order in which lines go through them.
class ValueAxis {
 public:
  explicit ValueAxis(const Variation& variation) : places_(numbers_of(variation.values, unit_)) {
    if (places_.empty()) {
      unit_.clear();
      places_.resize(variation.values.size());
      std::iota(places_.begin(), places_.end(), 0.);
      names_ = variation.values;
    }
    order_.resize(places_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, {}, [this](std::size_t i) { return places_[i]; });
  }

  Axis axis(const std::string& label) const {
    Axis axis{.label = label, .unit = unit_};
    axis.names = names_;
    const double least = places_[order_.front()];
    if (names_.empty() && least > 0 && places_[order_.back()] >= kWideSpread * least) axis.scale = Scale::log;
    return axis;
  }

  /// A line through a number for each value.
  Series line(std::string name, const std::vector<double>& numbers) const {
    Series series{.name = std::move(name), .draw = Draw::line};
    for (const std::size_t i : order_) {
      series.x.push_back(places_[i]);
      series.y.push_back(numbers[i]);
    }
    return series;
  }

 private:
  std::string unit_;
  std::vector<double> places_;  // by value
  std::vector<std::string> names_;
  std::vector<std::size_t> order_;
};

/// For each choice of the other variations, in their order: its name and the rows by the values of the k-th.
std::map<std::vector<std::size_t>, std::vector<std::size_t>> rows_by_others(const SweepPlan& plan,
                                                                            std::size_t k) {
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> lines;
  for (std::size_t i = 0; i < plan.combinations.size(); ++i) {
    std::vector<std::size_t> others = plan.combinations[i].choices;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    lines[others].push_back(i);
  }
  return lines;
}

std::string name_of(const SweepPlan& plan, const Combination& combination, std::size_t k) {
  std::string name;
  for (std::size_t v = 0; v < plan.variations.size(); ++v) {
    const Variation& variation = plan.variations[v];
    if (v == k || variation.values.size() == 1) continue;
    name += (name.empty() ? "" : ", ") + variation.key + "=" + variation.values[combination.choices[v]];
  }
  return name;
}

std::vector<double> counts_of(const std::vector<SweepRow>& rows, const std::vector<std::size_t>& line,
                              Count count) {
  std::vector<double> counts;
  counts.reserve(line.size());
  for (const std::size_t row : line) counts.push_back(count_of(rows[row], count));
  return counts;
}

}  // namespace

std::optional<Plot> sweep_plot(const SweepPlan& plan, const std::vector<SweepRow>& rows, std::size_t k) {
  const Variation& variation = plan.variations[k];
  if (variation.values.size() < 2) return std::nullopt;
  const ValueAxis values(variation);
  Plot plot;
  plot.x = values.axis(variation.key);
  plot.y = {.label = "critical points", .scale = Scale::log};
  std::vector<Series>& series = plot.panels.emplace_back().series;
  const auto add = [&](std::string name, const std::vector<double>& counts) {
    Series line = values.line(std::move(name), counts);
    set_line_style(line, series.size());
    series.push_back(std::move(line));
  };
  const auto lines = rows_by_others(plan, k);
  if (lines.size() == 1) {
    const std::vector<std::size_t>& line = lines.begin()->second;
    const std::pair<const char*, Count> kinds[] = {
        {"total", total_of},
        {"minima", [](const morse::CriticalPoints& points) { return points.minima; }},
        {"saddles", [](const morse::CriticalPoints& points) { return points.saddles; }},
        {"maxima", [](const morse::CriticalPoints& points) { return points.maxima; }}};
    for (const auto& [name, count] : kinds) {
      const std::vector<double> counts = counts_of(rows, line, count);
      // A logarithmic axis has no 0.
      if (std::ranges::min(counts) > 0) add(name, counts);
    }
  } else if (lines.size() <= kMostLines) {
    for (const auto& [others, line] : lines)
      add(name_of(plan, plan.combinations[line.front()], k), counts_of(rows, line, total_of));
  } else {
    std::vector<double> median, least, most;
    for (std::size_t i = 0; i < variation.values.size(); ++i) {
      std::vector<double> counts;
      counts.reserve(lines.size());
      for (const auto& [others, line] : lines) counts.push_back(count_of(rows[line[i]], total_of));
      std::ranges::sort(counts);
      median.push_back(counts[(counts.size() - 1) / 2]);
      least.push_back(counts.front());
      most.push_back(counts.back());
    }
    add("most", most);
    add("median", median);
    add("least", least);
    plot.notes.push_back("Of the " + grouped(lines.size()) + " combinations of all other parameters.");
  }
  return plot;
}

}  // namespace morsel::tools::plot
