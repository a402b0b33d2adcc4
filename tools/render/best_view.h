#pragma once
/// The view in which the most salient surface is visible.

#include <span>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/body.h"
#include "morsel/tools/render/camera.h"
#include "morsel/tools/render/rays.h"

namespace morsel::tools::render {

/// The view with the largest sum of visible weights: Lee, Varshney, Jacobs 2005, "Mesh saliency",
/// section 5.2. There `weights` is the saliency of each vertex (not negative; one a vertex), and here each
/// vertex also counts with its area, so that finely meshed regions do not count more. A vertex is visible if
/// it faces the viewer, weighted by the cosine, and is not occluded. Instead of the paper's gradient ascent
/// from a random start, 300 directions, evenly spread from 10° below the horizon to 50° above it, are tried,
/// then ever smaller neighbourhoods of the best. At most 5,000 vertices are tested. Deterministic; parallel.
View best_view(const Body& body, const Rays& rays, std::span<const double> weights, UpAxis up = UpAxis::y,
               const core::Progress& progress = {});

/// The mesh saliency (of the mean curvature, with the paper's scales) of each vertex; 1 each if it is 0
/// everywhere.
std::vector<double> view_weights(const Body& body, const core::Progress& progress = {});

}  // namespace morsel::tools::render
