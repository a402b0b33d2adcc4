#pragma once
/// A command line as text, to be copied into a shell.

#include <string>
#include <vector>

namespace morsel::tools {

/// The words separated by spaces, those quoted that a POSIX shell would not take as they are.
std::string command_line(const std::vector<std::string>& words);

}  // namespace morsel::tools
