#pragma once
/// Reading a report of landmarks back, to run it again.

#include <filesystem>
#include <optional>
#include <string>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/report/report_document.h"
#include "morsel/tools/study/landmarks.h"

namespace morsel::tools {

struct LoadedLandmarks {
  ReportDocument document;
  LandmarksRequest request;
  core::BuildOptions build = {};
  std::string list_path;  ///< as in the report
};

/// Nothing if the document is of another schema. Throws BadInput if the file is missing, is not JSON or is
/// damaged; of results nothing is checked: a comparison of reports shows all errors as differences.
std::optional<LoadedLandmarks> read_landmarks(const std::filesystem::path& path);
/// The same of a stream; errors call it `name`.
std::optional<LoadedLandmarks> read_landmarks(std::istream& in, const std::string& name);

/// The report that the same request gives now of the list at `list`. Throws InvalidArgument on a request that
/// this version does not support, and what run_landmarks() throws.
ReportDocument run_again(const LoadedLandmarks& report, const std::filesystem::path& list,
                         const Registry& registry = Registry::standard(),
                         const core::Progress& progress = {});

}  // namespace morsel::tools
