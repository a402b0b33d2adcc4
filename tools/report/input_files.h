#pragma once
/// The files besides the mesh that a run reads.

#include <string>
#include <vector>

#include "morsel/tools/report/json_stream.h"

namespace morsel::tools {

/// [{"path", "sha256"}] of each file that a value in these fields and methods names, by path. A value that happens to be the name
/// of a file is taken for one. Throws BadInput on one that cannot be read.
Json input_files(const std::vector<std::string>& specifications);

}  // namespace morsel::tools
