#pragma once
/// Reading a report back, to run it again.

#include <filesystem>

#include "morsel/core/error.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/report/report_document.h"

namespace morsel::tools {

/// A report and what it says was asked for.
struct LoadedReport {
  ReportDocument document;
  ComparisonRequest request;
  bool repair = false;
  bool items = true;      ///< false: left out, as was asked for
  std::string mesh_path;  ///< as it stands in the report
  std::string mesh_sha256;
};

/// The document is JSON, but of another schema.
class OtherDocument : public core::BadInput {
 public:
  using BadInput::BadInput;
};

/// Throws BadInput if the file is missing, is not JSON or is damaged, OtherDocument if it is not a report of this schema.
LoadedReport read_report(const std::filesystem::path& path);

/// Where the report's mesh lies now: its path from the working folder, or else from the report's own folder.
/// Empty if it is in neither place.
std::filesystem::path find_mesh(const LoadedReport& report, const std::filesystem::path& report_path);

}  // namespace morsel::tools
