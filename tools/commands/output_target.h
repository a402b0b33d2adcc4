#pragma once
/// Where an output of a command goes: a file, or standard output.

#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/commands.h"

namespace morsel::tools {

/// An output as the command line names it; - is standard output, in the format that the parser found
/// (CommonOptions::standard_output). Throws InvalidArgument if that is a terminal and the format binary.
core::FileTarget output_target(const std::string& path, const Run& run);

/// Prints what is for a person to read on standard output, unless an output goes there.
void show(const std::string& text, const Run& run);

/// Prints where an output is, if it is a file: "labels: PATH".
void tell_written(const std::string& what, const core::FileTarget& target, const Run& run);

}  // namespace morsel::tools
