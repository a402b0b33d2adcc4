#pragma once
/// The plots of a stability study: how well critical points repeat, over noise and over numbers of vertices.

#include <optional>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/study/stability.h"

namespace morsel::tools::plot {

/// The F-score over the strength of noise: a line for each method (of each field, if there are several; notes
/// have their texts if these are long), a panel for each count, the methods' own and the wanted one. Dotted,
/// if there are up to 7 lines, what chance gives. With one strength there are marks instead of lines. None if
/// the surface was not perturbed by noise.
std::optional<Plot> noise_plot(const StabilityPlan& plan, const StabilityResult& result);

/// Likewise over the number of vertices as a share of the clean surface's, on a logarithmic axis: fewer by
/// decimation, more by subdivision. Lines have a gap at the clean surface itself, where F is 1.
std::optional<Plot> vertices_plot(const StabilityPlan& plan, const StabilityResult& result,
                                  const core::TriangleMesh& clean);

}  // namespace morsel::tools::plot
