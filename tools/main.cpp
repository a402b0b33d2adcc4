// The morsel program: reads the command line, runs one command, turns errors into exit codes.

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/failure.h"
#include "morsel/tools/commands/help.h"
#include "morsel/tools/commands/parser.h"
#include "morsel/tools/commands/signals.h"
#include "morsel/tools/commands/stack.h"
#include "morsel/tools/commands/standard_input.h"
#include "morsel/tools/commands/standard_streams.h"
#include "morsel/tools/commands/threads.h"
#include "morsel/tools/formats/version.h"

namespace {

using namespace morsel;
using namespace morsel::tools;

/// From here to the end of the process as many threads as are wanted and can be made; results are the same
/// with any number.
void limit_threads(int wanted, Console& console) {
  // Never destroyed: without a limit oneTBB would make more, if only to end them.
  static std::array<core::ThreadLimit*, 2> limits{};
  if (wanted > 0) limits[0] = new core::ThreadLimit(wanted);
  const int all = core::thread_count();
  const int possible = possible_threads(all);
  if (possible == all) return;
  limits[1] = new core::ThreadLimit(possible);
  console.warning("of " + std::to_string(all) + " threads only " + std::to_string(possible) +
                  " can be made; results are the same");
}

std::vector<std::string> names_of(const std::deque<Command>& commands) {
  std::vector<std::string> names = {"help"};
  for (const Command& command : commands) names.push_back(command.name);
  return names;
}

Command* find(std::deque<Command>& commands, const std::string& name) {
  const auto found = std::ranges::find(commands, name, &Command::name);
  return found == commands.end() ? nullptr : &*found;
}

/// Whether a word in a command's place is the file to compare: there is one, or it is named like a mesh.
bool is_file(const std::string& word) {
  std::error_code error;
  return word == kStandardInput || core::has_mesh_extension(word) ||
         std::filesystem::is_regular_file(word, error);
}

Command& chosen(std::deque<Command>& commands, const std::string& name) {
  if (Command* command = find(commands, name)) return *command;
  throw core::InvalidArgument("there is no command \"" + name + "\"" +
                              core::nearest_hint(name, names_of(commands)) + " (morsel --help lists all)");
}

bool is_help(const std::string& word) { return word == "--help" || word == "-h"; }

/// `words` follow "help".
std::string help_text(std::deque<Command>& commands, std::vector<std::string> words) {
  std::erase_if(words, is_help);
  for (const std::string& word : words)
    if (word.starts_with('-'))
      throw core::InvalidArgument("help has no option " + word + " (morsel --help lists the commands)");
  if (words.size() > 1)
    throw core::InvalidArgument("\"" + words[1] + "\" is one argument too many: help takes one command");
  if (words.empty() || words[0] == "help") return program_help(commands);
  return command_help(chosen(commands, words[0]));
}

/// An option where a command is expected.
[[noreturn]] void refuse_leading(const std::string& word, const std::deque<Command>& commands) {
  const std::string name = word.substr(0, word.find('='));
  const bool is_of_command = std::ranges::any_of(commands, [&](const Command& command) {
    return std::ranges::any_of(command.options(), [&](const Option& row) { return row.is_called(name); });
  });
  if (is_of_command)
    throw core::InvalidArgument("the options of a command come after it, and " + word +
                                " came before (morsel --help lists the commands)");
  const std::vector<std::string> names = {"--help", "--version"};
  throw core::InvalidArgument("there is no option " + name + core::nearest_hint(name, names) +
                              " (morsel --help lists the commands)");
}

/// Throws what the streams' errors throw.
int run(std::vector<std::string> words, std::stop_token stop) {
  std::cout.exceptions(std::ios::badbit | std::ios::failbit);
  Program program;
  add_commands(program);
  const auto show = [](const std::string& text) {
    std::cout << text << std::flush;
    return kDone;
  };

  if (words.empty() || is_help(words[0])) return show(program_help(program.commands));
  if (words[0] == "--version") return show("morsel " + std::string(kVersion) + "\n");
  if (words[0] == "help") return show(help_text(program.commands, {words.begin() + 1, words.end()}));
  if (find(program.commands, words[0]) == nullptr && is_file(words[0]))
    words.insert(words.begin(), "compare");
  if (words[0].starts_with('-')) refuse_leading(words[0], program.commands);
  Command& command = chosen(program.commands, words[0]);
  if (std::any_of(words.begin() + 1, std::ranges::find(words, "--"), is_help))
    return show(command_help(command));

  words.erase(words.begin());
  program.common.command = shaping_command(command, words);
  program.common.standard_output = parse(command, words);
  const core::StopScope scope(stop);
  Console console(program.common.quiet, std::move(stop));
  limit_threads(program.common.threads, console);
  const int code = command.action(console);
  std::cout.flush();
  return code;
}

int run_to_exit_code(int argc, char** argv) noexcept {
  try {
    const SignalWatch watch;
    return run({argv + std::min(argc, 1), argv + argc}, watch.token());
  } catch (...) {
    return tell_failure();
  }
}

}  // namespace

int main(int argc, char** argv) {
  begin_main();
  try {
    occupy_standard_descriptors();
  } catch (...) {
    return tell_failure();
  }
  int code = 0;
  with_enough_stack([&] { code = run_to_exit_code(argc, argv); });
  return code;
}
