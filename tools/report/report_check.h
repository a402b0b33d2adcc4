#pragma once
/// Reports as regression tests: runs their comparisons, or studies of landmarks, again.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/report/difference.h"

namespace morsel::tools {

struct ReportCheck {
  bool is_of_landmarks = false;   ///< otherwise it is of a comparison
  std::string input_path;         ///< of the mesh, or of the list of meshes; as in the report
  std::size_t rows = 0;           ///< of a comparison a method each
  bool input_is_missing = false;  ///< then nothing was run
  std::vector<Difference> differences;

  bool is_unchanged() const { return !input_is_missing && differences.empty(); }
};

/// Runs a report's comparison, or its study of landmarks, again and compares. Throws OtherDocument or
/// BadInput (report_reader.h) on what is no report, BadInput also on a request that this version does not
/// support, and what comparisons throw.
ReportCheck check_report(const std::filesystem::path& report, const core::Progress& progress = {});

/// The .json files in a folder and the folders in it, by name. Throws BadInput if it cannot be read or has
/// none.
std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder);

}  // namespace morsel::tools
