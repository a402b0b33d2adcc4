#include "morsel/tools/plot/plot_sink.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/file_writer.h"
#include "morsel/core/parallel.h"

namespace morsel::tools {
namespace {

using NamedPlot = std::pair<std::filesystem::path, plot::Plot>;  // the path without its ending

void write(std::vector<NamedPlot> plots, const Provenance& provenance) {
  for (NamedPlot& plot : plots) plot.second.metadata = provenance.json();
  core::parallel_for(0, 2 * plots.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& [base, plot] = plots[i / 2];
    constexpr double kPixelsAPoint = 300. / 72;
    if (i % 2 == 0)
      plot::write_svg(base.string() + ".svg", plot);
    else
      plot::write_png(base.string() + ".png", plot,
                      static_cast<int>(std::lround(plot.width * kPixelsAPoint)));
  });
}

}  // namespace

PlotSink::PlotSink(std::filesystem::path folder, Provenance provenance)
    : folder_(std::move(folder)), provenance_(std::move(provenance)), all_(provenance_) {
  make_folder(folder_);
}

void PlotSink::field(const FieldOutcome& outcome) {
  field_ = outcome.name;
  std::replace(field_.begin(), field_.end(), '-', ' ');
  provenance_.set_field(outcome);
  all_ = provenance_;
}

void PlotSink::method(const MethodOutcome& outcome) {
  const std::string name = names_.next(outcome.name);
  methods_.push_back(plot::curves_of(outcome));
  write({{folder_ / (name + ".diagram"), plot::diagram_plot(methods_.back(), field_)}},
        provenance_.with_method(outcome.steps));
  all_.add_method(outcome.steps);
}

void PlotSink::finish() {
  std::vector<NamedPlot> plots;
  plots.emplace_back(folder_ / "diagrams", plot::diagram_sheet(methods_, field_));
  plots.emplace_back(folder_ / "persistence", plot::persistence_plot(methods_, field_));
  plots.emplace_back(folder_ / "iterations", plot::iteration_plot(methods_));
  std::erase_if(plots, [](const NamedPlot& plot) { return plot.second.panels.empty(); });
  write(std::move(plots), all_);
}

}  // namespace morsel::tools
