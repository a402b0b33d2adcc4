#pragma once
/// Plots as files.

#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/result_folder.h"

namespace morsel::tools::plot {

/// A plot and its file's name without the ending.
using NamedPlot = std::pair<std::string, Plot>;

/// Each as .svg and as .png of 300 pixels an inch, in parallel, with its provenance. Throws what
/// claim(), write_svg() and write_png() throw.
void write_plots(ResultFolder& folder, std::vector<NamedPlot> plots, const Provenance& provenance);

}  // namespace morsel::tools::plot
