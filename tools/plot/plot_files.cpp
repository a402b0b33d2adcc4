#include "morsel/tools/plot/plot_files.h"

#include <cmath>
#include <filesystem>

#include "morsel/core/parallel/parallel.h"

namespace morsel::tools::plot {

void write_plots(ResultFolder& folder, std::vector<NamedPlot> plots, const Provenance& provenance) {
  std::vector<std::filesystem::path> paths;  // listed in this order at any number of threads
  for (NamedPlot& plot : plots) {
    plot.second.metadata = provenance.json();
    paths.push_back(folder.claim(plot.first + ".svg"));
    paths.push_back(folder.claim(plot.first + ".png"));
  }
  core::parallel_for(0, 2 * plots.size(), 1, [&](std::size_t i, std::size_t) {
    const Plot& plot = plots[i / 2].second;
    constexpr double kPixelsAPoint = 300. / 72;
    if (i % 2 == 0)
      write_svg(paths[i], plot);
    else
      write_png(paths[i], plot, static_cast<int>(std::lround(plot.width * kPixelsAPoint)));
  });
}

}  // namespace morsel::tools::plot
