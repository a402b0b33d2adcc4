#pragma once
/// What the program says of itself, from the tables of its commands.

#include <deque>
#include <string>

#include "morsel/tools/commands/command.h"

namespace morsel::tools {

/// All commands, a line each, and the exit codes.
std::string program_help(const std::deque<Command>& commands);
/// One command: usage, options, examples, notes.
std::string command_help(const Command& command);

/// What the program ends with, as a sentence.
extern const char* const kExitCodes;

/// "MESH -o OUT [OPTIONS]": what a command cannot do without.
std::string usage(const Command& command);
/// "-o, --output FILE", as help shows it; of a flag with a negation "--points, --no-points".
std::string option_heading(const Option& option);
/// Help and default in one text, with the details between them where they are wanted.
std::string option_text(const Option& option, bool with_details = false);
/// `text` in lines of at most `width` bytes where words allow, each after `indent` spaces but for the first.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace morsel::tools
