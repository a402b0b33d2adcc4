#pragma once
/// The plots of a study of landmarks: errors over the radius, and F-scores over the meshes.

#include <vector>

#include "morsel/tools/plot/plot.h"
#include "morsel/tools/study/landmarks.h"

namespace morsel::tools::plot {

/// False negatives and false positives (MarkScore) against the radius, side by side on the width of a page; a
/// line for each row. In the unit of the largest radius.
Plot landmark_errors(const LandmarksPlan& plan, const std::vector<LandmarksSummary>& summaries);

/// For each row the share of the meshes whose F-score is at least what x says.
Plot landmark_scores(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes);

}  // namespace morsel::tools::plot
