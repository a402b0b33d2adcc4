#pragma once
/// The result of a study of landmarks as a table for people.

#include <string>
#include <vector>

#include "morsel/tools/study/landmarks.h"

namespace morsel::tools {

/// A row for each field and method and for chance, the means over the meshes with their intervals, and what
/// the columns mean.
std::string landmarks_table(const LandmarksPlan& plan, const std::vector<LandmarksOnMesh>& meshes,
                            const std::vector<LandmarksSummary>& summaries);

}  // namespace morsel::tools
