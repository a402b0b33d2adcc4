#pragma once
/// Plots as files.

#include <filesystem>
#include <utility>
#include <vector>

#include "morsel/tools/plot/plot.h"

namespace morsel::tools::plot {

/// A plot and its path without the ending.
using NamedPlot = std::pair<std::filesystem::path, Plot>;

/// Each as .svg and as .png of 300 pixels an inch, in parallel. Throws what write_svg() and write_png() throw.
void write_plots(const std::vector<NamedPlot>& plots);

}  // namespace morsel::tools::plot
