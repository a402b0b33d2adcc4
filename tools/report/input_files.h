#pragma once
/// The files besides the mesh that a run reads.

#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/registry.h"
#include "morsel/tools/study/stability.h"

namespace morsel::tools {

/// The files that keys of a Morse function, in the syntax of the command line, name: "NAME:KEY" and the path.
/// Throws InvalidArgument as make_function().
std::vector<std::pair<std::string, std::string>> named_files(const std::string& field,
                                                             const Registry& registry = Registry::standard());

/// Each file that these Morse functions, in the syntax of the command line, are to read, by path. Missing
/// ones are left out: the function itself reports a more specific error. Throws InvalidArgument as
/// make_function(), BadInput on one that cannot be read.
std::vector<HashedFile> input_files(const std::vector<std::string>& fields,
                                    const Registry& registry = Registry::standard());

/// The files that the fields and the reference field of a stability study read; throws likewise.
std::vector<HashedFile> input_files(const StabilityRequest& request,
                                    const Registry& registry = Registry::standard());

/// The files that a field was read from. Throws BadInput on one that cannot be read any more.
std::vector<HashedFile> hashed_files(const FieldOutcome& field);

/// [{"path", "sha256"}]
Json files_section(const std::vector<HashedFile>& files);

}  // namespace morsel::tools
