#include "morsel/tools/manual/man_pages.h"

#include <algorithm>
#include <string_view>

#include "morsel/tools/commands/help.h"
#include "morsel/tools/formats/version.h"

namespace morsel::tools {
namespace {

/// Text as roff has it: neither a request nor an escape, and hyphens that can be copied.
std::string plain(std::string_view text) {
  std::string escaped = !text.empty() && (text[0] == '.' || text[0] == '\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }

std::string heading(const std::string& name, const std::string& summary) {
  std::string upper = name;
  std::ranges::transform(upper, upper.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return ".TH " + upper + " 1 \"\" \"morsel " + std::string(kVersion) + "\" \"morsel\"\n.SH NAME\n" +
         plain(name) + " \\- " + plain(summary) + "\n";
}

std::string entry(const Option& option) {
  std::string names;
  for (const std::string& name : option.all_names()) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.implied.empty())
    names += "[=\\fI" + plain(option.value_name) + "\\fR]";
  else if (!option.is_flag() && !option.is_argument())
    names += " \\fI" + plain(option.value_name) + "\\fR";
  return ".TP\n" + names + "\n" + plain(option_text(option, true)) + "\n";
}

std::string paragraphs(const std::string& text) {
  std::string roff;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    roff += ".PP\n" + plain(text.substr(begin, end - begin)) + "\n";
    begin = end + 2;
  }
  return roff;
}

std::string entries(const Command& command, bool arguments) {
  std::string roff;
  std::string group;
  for (const Option& option : command.options()) {
    if (option.is_argument() != arguments) continue;
    if (!arguments && option.group != group) roff += ".SS " + plain(group = option.group) + "\n";
    roff += entry(option);
  }
  return roff;
}

}  // namespace

std::string command_man_page(const Command& command) {
  std::string roff = heading("morsel-" + command.name, command.summary);
  roff += ".SH SYNOPSIS\n" + bold("morsel " + command.name) + " " + plain(usage(command)) + "\n";
  if (const std::string arguments = entries(command, true); !arguments.empty())
    roff += ".SH ARGUMENTS\n" + arguments;
  if (const std::string options = entries(command, false); !options.empty())
    roff += ".SH OPTIONS\n" + options;
  roff += ".SH EXAMPLES\n";
  for (const Example& example : command.examples)
    roff += ".TP\n" + bold("morsel " + example.words) + "\n" + plain(example.does) + "\n";
  if (!command.notes.empty() || !command.details.empty())
    roff += ".SH NOTES\n" + paragraphs(command.notes) + paragraphs(command.details);
  return roff + ".SH EXIT STATUS\n" + plain(kExitCodes) + "\n.SH SEE ALSO\n" + bold("morsel") + "(1)\n";
}

std::string program_man_page(const std::deque<Command>& commands) {
  std::string roff = heading(
      "morsel",
      "critical points of scalar fields on triangle meshes, by several methods compared with each other");
  roff += ".SH SYNOPSIS\n" + bold("morsel") + " MESH [OPTIONS]\n.br\n" + bold("morsel") +
          " COMMAND ARGUMENTS [OPTIONS]\n.SH COMMANDS\n";
  for (const Command& command : commands)
    roff += ".TP\n" + bold("morsel-" + command.name) + "(1)\n" + plain(command.summary) + "\n";
  return roff + ".SH EXIT STATUS\n" + plain(kExitCodes) + "\n";
}

}  // namespace morsel::tools
