#pragma once
/// A command line as text, to be copied into a shell.

#include <string>
#include <vector>

namespace morsel::tools {

/// The words separated by spaces, quoted where a POSIX shell would not take them literally.
std::string command_line(const std::vector<std::string>& words);

/// Appends the words that give an option a value: "--name", "value", or in one word where the value begins as
/// an option does.
void add_option(std::vector<std::string>& words, const std::string& name, const std::string& value);
/// Appends further words.
void add_words(std::vector<std::string>& words, const std::vector<std::string>& more);
/// Appends the option if `given`.
void add_flag(std::vector<std::string>& words, const std::string& name, bool given);

}  // namespace morsel::tools
