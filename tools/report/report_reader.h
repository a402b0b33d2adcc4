#pragma once
/// Reading a report back, to run it again.

#include <filesystem>
#include <fstream>
#include <istream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/tools/report/report_document.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// A report and its request.
struct LoadedReport {
  ReportDocument document;
  ComparisonRequest request;
  core::BuildOptions build = {};
  std::string format = {};  ///< of the mesh, where it is not its extension's
  bool items = true;        ///< false: left out, as requested
  std::string mesh_path;    ///< as in the report
  std::string mesh_sha256;
};

/// Throws BadInput if the file is missing, not a regular file, not JSON or damaged, OtherDocument if it is
/// not a report of this schema. Of results and of lists of methods only the methods' names are checked: a
/// comparison of reports shows all other errors as differences.
LoadedReport read_report(const std::filesystem::path& path);
/// The same of a stream; errors call it `name`.
LoadedReport read_report(std::istream& in, const std::string& name);

/// Opens the file of a report; throws BadInput if it is missing or a folder.
std::ifstream open_report(const std::filesystem::path& path);

/// The place of a report's input now: its path, as the report has it, from the working folder, or else from
/// the report's own folder. Empty if it is in neither.
std::filesystem::path find_input(const std::filesystem::path& path, const std::filesystem::path& report_path);

}  // namespace morsel::tools
