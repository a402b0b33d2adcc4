#pragma once
/// A command line as text, to be copied into a shell.

#include <string>
#include <vector>

namespace morsel::tools {

/// The words separated by spaces, quoted where a POSIX shell would not take them literally.
std::string command_line(const std::vector<std::string>& words);

}  // namespace morsel::tools
