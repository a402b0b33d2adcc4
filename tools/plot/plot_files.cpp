#include "morsel/tools/plot/plot_files.h"

#include <cmath>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools::plot {

void write_plots(ResultFolder& folder, std::vector<NamedPlot> plots, const Provenance& provenance) {
  std::vector<core::FileTarget> targets;
  for (NamedPlot& plot : plots) {
    plot.second.metadata = provenance.json();
    targets.push_back(folder.claim(plot.first + ".svg"));
    targets.push_back(folder.claim(plot.first + ".png"));
  }
  core::parallel_for(0, 2 * plots.size(), 1, [&](std::size_t i, std::size_t) {
    const Plot& plot = plots[i / 2].second;
    constexpr double kPixelsAPoint = 300. / 72;
    if (i % 2 == 0)
      write_svg(targets[i], plot);
    else
      write_png(targets[i], plot, static_cast<int>(std::lround(plot.width * kPixelsAPoint)));
  });
}

}  // namespace morsel::tools::plot
