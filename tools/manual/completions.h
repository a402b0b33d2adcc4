#pragma once
/// Completions of command lines for shells, from the tables of the commands and the registry's names.

#include <deque>
#include <string>

#include "morsel/tools/commands/command.h"

namespace morsel::tools {

std::string bash_completion(const std::deque<Command>& commands);
std::string zsh_completion(const std::deque<Command>& commands);
std::string fish_completion(const std::deque<Command>& commands);

}  // namespace morsel::tools
