#pragma once
/// The plots of a sweep: critical points against each of the varied parameters.

#include <optional>
#include <vector>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::tools::plot {

/// Critical points against the k-th variation of a parameter sweep: if its values have one unit, on an axis
/// of numbers (a logarithmic one if they spread by a factor of 30), else on one of names, in the order given.
/// If nothing else varies, there is a line for the total and one for each type; if the other parameters have
/// up to 14 combinations, a line for each; else the median, minimum and maximum over them. None if the
/// variation has only one value.
std::optional<Plot> sweep_plot(const SweepPlan& plan, const std::vector<SweepRow>& rows, std::size_t k);

}  // namespace morsel::tools::plot
