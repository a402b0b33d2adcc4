#pragma once
/// Keys and iterations of the methods that run salient smoothing.

#include <string>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/smoothing/iteration.h"
#include "morsel/morse/smoothing/salient.h"

namespace morsel::morse {

/// Declare and read the keys of that name.
void read_sigma(core::ParameterReader& reader, SalientOptions& options);
void read_support(core::ParameterReader& reader, SalientOptions& options);
/// weights=none|area and ball=euclidean|connected.
void read_neighbors(core::ParameterReader& reader, SalientOptions& options);

/// Says so if most balls of `radius` around vertices hold no other vertex, where smoothing does nothing.
std::vector<std::string> empty_ball_warnings(const core::TriangleMesh& mesh, double radius);

/// Runs iterations of salient() until the control, made of `criteria`, ends them.
SalientResult run_salient(const core::ScalarField& input, SalientOptions options,
                          const StopCriteria& criteria, IterationControl& control,
                          const core::Progress& progress);

}  // namespace morsel::morse
