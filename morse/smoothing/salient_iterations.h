#pragma once
/// Salient smoothing under the control of a method: of `salient`, and of `gaussian`, which is computed by it.

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/morse/smoothing/iteration.h"
#include "morsel/morse/smoothing/salient.h"

namespace morsel::morse {

/// Runs iterations of salient() until the control, made of `criteria`, ends them.
SalientResult run_salient(const core::ScalarField& input, SalientOptions options,
                          const StopCriteria& criteria, IterationControl& control,
                          const core::Progress& progress);

}  // namespace morsel::morse
