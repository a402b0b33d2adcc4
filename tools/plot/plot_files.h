#pragma once
/// Plots as files.

#include <filesystem>
#include <utility>
#include <vector>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools::plot {

/// A plot and its path without the ending.
using NamedPlot = std::pair<std::filesystem::path, Plot>;

/// Each as .svg and as .png of 300 pixels an inch, in parallel, with where it comes from in it. Throws what write_svg() and write_png() throw.
void write_plots(std::vector<NamedPlot> plots, const Provenance& provenance);

}  // namespace morsel::tools::plot
