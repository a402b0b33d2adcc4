#pragma once
/// What a collection is run with, and the key by which it is known whether a mesh's report is still right.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "morsel/tools/batch/child.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/report/json_stream.h"

namespace morsel::tools::batch {

/// What the results follow from, besides the meshes.
struct BatchRequest {
  ComparisonRequest comparison;
  bool repair = false;
  bool items = true;       ///< whether reports list critical points and pairs
  bool thumbnails = true;  ///< whether there is a picture of the first and of the last method
};

/// Valid UTF-8 of any bytes (a path, an error), as JSON documents have it: what is read back from one is the same text.
std::string valid_text(const std::string& text);

/// {"tool", "request", "files"}: all that reports follow from, except the mesh. "files" has name and hash of each file that a
/// value in --field or --method names. Throws BadInput on one that cannot be read.
Json common_key(const BatchRequest& request);

/// `common` with the mesh's "sha256"; null for one that cannot be read.
Json mesh_key(const Json& common, const std::filesystem::path& mesh);

/// The arguments of the program that compare one mesh, the program's name first.
std::vector<std::string> compare_words(const BatchRequest& request, const std::filesystem::path& mesh,
                                       const std::filesystem::path& report,
                                       const std::filesystem::path& thumbnails, int threads);

}  // namespace morsel::tools::batch
