#pragma once
/// Man pages (section 1, in the macros of groff's man package), from the tables of the commands.

#include <deque>
#include <string>

#include "morsel/tools/commands/command.h"

namespace morsel::tools {

std::string program_man_page(const std::deque<Command>& commands);
std::string command_man_page(const Command& command);

}  // namespace morsel::tools
