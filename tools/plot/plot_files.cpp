#include "morsel/tools/plot/plot_files.h"

#include <cmath>

#include "morsel/core/parallel.h"

namespace morsel::tools::plot {

void write_plots(ResultFolder& folder, std::vector<NamedPlot> plots, const Provenance& provenance) {
  for (NamedPlot& plot : plots) plot.second.metadata = provenance.json();
  core::parallel_for(0, 2 * plots.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& [name, plot] = plots[i / 2];
    constexpr double kPixelsAPoint = 300. / 72;
    if (i % 2 == 0)
      write_svg(folder.claim(name + ".svg"), plot);
    else
      write_png(folder.claim(name + ".png"), plot, static_cast<int>(std::lround(plot.width * kPixelsAPoint)));
  });
}

}  // namespace morsel::tools::plot
