#include "morsel/tools/commands/help.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace morsel::tools {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kColumn = 28;  // where texts begin

/// A heading with its text beside it, or below it if there is no room.
std::string row(const std::string& heading, const std::string& text) {
  std::string line = "  " + heading;
  if (line.size() + 2 > kColumn)
    line += "\n" + std::string(kColumn, ' ');
  else
    line.resize(kColumn, ' ');
  return line + wrapped(text, kColumn, kWidth) + "\n";
}

/// The row of an option, or of several whose texts are another command's; `at` is moved behind them.
std::string next_row(const std::deque<Option>& options, std::size_t& at) {
  const Option& first = options[at++];
  if (first.told_by.empty()) return row(option_heading(first), option_text(first));
  std::string names = first.names;
  for (; at < options.size() && options[at].told_by == first.told_by; ++at) names += ", " + options[at].names;
  return row(names, "As of morsel " + first.told_by + ", whose help tells them");
}

}  // namespace

const char* const kExitCodes =
    "0 done; 1 a check found differences, or a mesh of a batch failed; 2 wrong usage; 3 bad input; 4 writing "
    "failed; 5 out of memory, threads or open files; 130 and 143 interrupted.";

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string lines;
  std::size_t column = indent;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    if (column > indent && column + 1 + word.size() > width) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) lines += ' ', ++column;
    lines += word;
    column += word.size();
  }
  return lines;
}

std::string option_heading(const Option& option) {
  std::string heading;
  for (const std::string& name : option.all_names()) heading += (heading.empty() ? "" : ", ") + name;
  if (!option.implied.empty())
    heading += "[=" + option.value_name + "]";
  else if (!option.is_flag() && !option.is_argument())
    heading += " " + option.value_name;
  return heading + (option.is_argument() && option.is_repeated ? " ..." : "");
}

std::string option_text(const Option& option, bool with_details) {
  std::string text = option.help;
  if (with_details && !option.details.empty()) text += ". " + option.details;
  if (!option.default_text.empty()) text += " [" + option.default_text + "]";
  return text;
}

std::string usage(const Command& command) {
  std::string line;
  bool more = false;
  for (const Option& option : command.options()) {
    if (option.is_argument())
      line += " " + (option.is_required ? option.names : "[" + option.names + "]") +
              (option.is_repeated ? "..." : "");
    else if (option.is_required)
      line += " " + option.all_names().front() + " " + option.value_name;
    else
      more = true;
  }
  return line.substr(line.empty() ? 0 : 1) + (more ? " [OPTIONS]" : "");
}

std::string command_help(const Command& command) {
  std::string text = "Usage: morsel " + command.name + " " + usage(command) + "\n" +
                     wrapped(command.summary + ".", 0, kWidth) + "\n\n";
  for (const Option& option : command.options())
    if (option.is_argument()) text += row(option_heading(option), option_text(option));
  std::string group;
  for (std::size_t at = 0; at < command.options().size();) {
    const Option& option = command.options()[at];
    if (option.is_argument()) {
      ++at;
      continue;
    }
    if (option.group != group) text += "\n" + (group = option.group) + ":\n";
    text += next_row(command.options(), at);
  }
  if (!command.examples.empty()) text += "\nExamples:\n";
  for (const Example& example : command.examples)
    text += "  morsel " + example.words + "\n      " + wrapped(example.does, 6, kWidth) + "\n";
  for (std::size_t begin = 0; begin < command.notes.size();) {
    const std::size_t end = std::min(command.notes.find("\n\n", begin), command.notes.size());
    text += "\n" + wrapped(command.notes.substr(begin, end - begin), 0, kWidth) + "\n";
    begin = end + 2;
  }
  return text;
}

std::string program_help(const std::deque<Command>& commands) {
  std::string text =
      "Critical points of scalar fields on triangle meshes, by several methods compared with each other.\n\n"
      "Usage: morsel MESH [OPTIONS]             the same as morsel compare MESH [OPTIONS]\n"
      "       morsel COMMAND ARGUMENTS [OPTIONS]\n\nCommands:\n";
  for (const Command& command : commands) text += row(command.name, command.summary);
  text += row("help COMMAND", "Print help for a command, as morsel COMMAND --help does");
  text +=
      "\nExamples:\n"
      "  morsel scan.off                        critical points of a surface's curvature, three methods\n"
      "  morsel scan.off --figures out          the same with pictures\n"
      "  morsel info scan.off                   what a mesh is, and what is wrong with it\n";
  return text + "\n" + wrapped("Exit codes: " + std::string(kExitCodes), 0, kWidth) + "\n";
}

}  // namespace morsel::tools
