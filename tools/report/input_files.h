#pragma once
/// The files besides the mesh that a run reads.

#include <string>
#include <vector>

#include "morsel/tools/report/json_stream.h"
#include "morsel/tools/report/sha256.h"

namespace morsel::tools {

/// Each file that a value in these fields and methods names, by path. A value that happens to be the name of a file is taken for one.
/// Throws BadInput on one that cannot be read.
std::vector<HashedFile> input_files(const std::vector<std::string>& specifications);

/// [{"path", "sha256"}]
Json files_section(const std::vector<HashedFile>& files);

}  // namespace morsel::tools
