#include "morsel/tools/plot/plot_sink.h"

#include <algorithm>
#include <utility>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/plot/plot_files.h"

namespace morsel::tools {

PlotSink::PlotSink(ResultFolder& folder, Provenance provenance)
    : folder_(folder), provenance_(std::move(provenance)), all_(provenance_) {}

void PlotSink::field(const FieldOutcome& outcome) {
  field_ = outcome.name;
  std::replace(field_.begin(), field_.end(), '-', ' ');
  provenance_.set_field(outcome);
  all_ = provenance_;
}

void PlotSink::method(const MethodOutcome& outcome) {
  const std::string name = names_.next(outcome.name);
  methods_.push_back(plot::curves_of(outcome));
  plot::write_plots(folder_, {{name + ".diagram", plot::diagram_plot(methods_.back(), field_)}},
                    provenance_.with_method(outcome.steps));
  all_.add_method(outcome.steps);
}

void PlotSink::finish() {
  std::vector<plot::NamedPlot> plots;
  plots.emplace_back("diagrams", plot::diagram_sheet(methods_, field_));
  plots.emplace_back("persistence", plot::persistence_plot(methods_, field_));
  plots.emplace_back("iterations", plot::iteration_plot(methods_));
  std::erase_if(plots, [](const plot::NamedPlot& plot) { return plot.second.panels.empty(); });
  plot::write_plots(folder_, std::move(plots), all_);
}

}  // namespace morsel::tools
