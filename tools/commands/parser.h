#pragma once
/// Command lines, by CLI11, which this file's source alone includes: compiling it takes as long as ten
/// commands.

#include <string>
#include <vector>

#include "morsel/tools/commands/command.h"

namespace morsel::tools {

/// Gives the words after the command's name to its options. Throws InvalidArgument, a sentence with the
/// nearest name where one is unknown. Returns the format, without dot, of the output that is standard output
/// (OutputFormats); "" if none is.
std::string parse(Command& command, const std::vector<std::string>& words);

}  // namespace morsel::tools
