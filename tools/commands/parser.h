#pragma once
/// Command lines, by CLI11, which this file's source alone includes: compiling it takes as long as ten
/// commands.

#include <string>
#include <vector>

#include "morsel/tools/commands/command.h"

namespace morsel::tools {

/// Gives the words after the command's name to its options. Throws InvalidArgument, a sentence with the
/// nearest name where one is unknown.
void parse(Command& command, std::vector<std::string> words);

}  // namespace morsel::tools
