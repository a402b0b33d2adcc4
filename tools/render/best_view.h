#pragma once
/// The view that shows the most.

#include <span>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/body.h"
#include "morsel/tools/render/camera.h"
#include "morsel/tools/render/rays.h"

namespace morsel::tools::render {

/// The view from which the sum of what is seen is largest: Lee, Varshney, Jacobs 2005, "Mesh saliency",
/// section 5.2. There `weights` is the saliency of each vertex (not negative; one a vertex), and here each
/// vertex also counts with its area, so that finely meshed regions do not draw the eye. A vertex is seen if
/// it faces the viewer, by the cosine, and nothing is in between. Where the paper climbs from a random start,
/// 300 directions, evenly spread from 10° below the horizon to 50° above it, are tried, then the surroundings
/// of the best ever closer. At most 5,000 vertices are looked at. Deterministic; parallel.
View best_view(const Body& body, const Rays& rays, std::span<const double> weights, UpAxis up = UpAxis::y,
               const core::Progress& progress = {});

/// The mesh saliency (of the mean curvature, with the paper's scales) of each vertex; 1 each if there is none
/// anywhere.
std::vector<double> view_weights(const Body& body, const core::Progress& progress = {});

}  // namespace morsel::tools::render
