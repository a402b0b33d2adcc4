#pragma once
/// The result of a study of landmarks, as a JSON document ("morsel.landmarks/1", see landmarks.schema.json)
/// and as CSV.

#include <ostream>
#include <vector>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/report/marked_files.h"
#include "morsel/tools/study/landmarks.h"

namespace morsel::tools {

inline constexpr const char* kLandmarksSchema = "morsel.landmarks/1";

/// A run; refers to all of it.
struct LandmarksReport {
  const MarkedFiles& files;
  const LandmarksPlan& plan;
  const std::vector<LandmarksOnMesh>& meshes;
  const std::vector<LandmarksSummary>& summaries;
  const std::vector<HashedFile>& field_files;  ///< those that the fields read
  double seconds;                              ///< of the run

  /// All files that were read.
  std::vector<HashedFile> inputs() const;
};

/// The Morse functions of a request, the one that fills up among them.
std::vector<std::string> fields_of(const LandmarksRequest& request);

/// The request in the syntax of the command line.
Json request_section(const LandmarksRequest& request, const core::BuildOptions& build);

/// All that the result of a mesh depends on besides its two files: the key of their journal.
Json landmarks_key(const LandmarksRequest& request, const core::BuildOptions& build,
                   const std::vector<HashedFile>& field_files);

/// The whole document: rows over all meshes, then every mesh. Of its members only "timings" differs between
/// runs.
void write_landmarks(JsonSink& json, const LandmarksReport& report);

/// A row for each mesh and row, with the program's version, hashes, the seed and all resolved parameters.
/// Without timings, so always the same bytes.
void write_landmarks_csv(std::ostream& out, const LandmarksReport& report);

}  // namespace morsel::tools
