#pragma once
/// Reading a report back, to run it again.

#include <filesystem>
#include <istream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/report/report_document.h"
#include "morsel/tools/study/comparison.h"

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

/// Throws BadInput if the file is missing, is not JSON or is damaged, OtherDocument if it is not a report of
/// this schema. Of what methods list, and of results, nothing is checked but the methods' names: whoever
/// compares them finds what is wrong with them as differences.
LoadedReport read_report(const std::filesystem::path& path);
/// The same of a stream; errors call it `name`.
LoadedReport read_report(std::istream& in, const std::string& name);

/// Where the report's mesh lies now: its path from the working folder, or else from the report's own folder.
/// Empty if it is in neither place.
std::filesystem::path find_mesh(const LoadedReport& report, const std::filesystem::path& report_path);

}  // namespace morsel::tools
