#pragma once
/// Writes and reads what landmarks have on one mesh, in documents and journals.

#include <span>

#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/landmarks.h"

namespace morsel::tools {

/// {"wanted", "radius", "spacing", "warnings" (if there are any), "fields", "rows"}, see
/// landmarks.schema.json; `known` as for field_parameters().
Json result_section(const LandmarksOnMesh& result, const LandmarksPlan& plan,
                    std::span<const HashedFile> known = {});

/// The result that a section of the same plan was made of, without its seconds. Throws BadInput (json_view.h)
/// on other shapes and on counts that no scores have.
LandmarksOnMesh read_result(const JsonView& section, const LandmarksPlan& plan);

}  // namespace morsel::tools
