// morsel_manual DIR: writes the man pages and the completions of bash, zsh and fish there, from the tables
// that --help is made from: man1/morsel.1, man1/morsel-COMMAND.1, bash/morsel, zsh/_morsel, fish/morsel.fish.

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/manual/completions.h"
#include "morsel/tools/manual/man_pages.h"

int main(int argc, char** argv) {
  using namespace morsel;
  using namespace morsel::tools;
  if (argc != 2) {
    std::cerr << "morsel_manual: one argument is needed, the folder to write to\n";
    return kWrongUsage;
  }
  try {
    const std::filesystem::path folder = argv[1];
    Program program;
    add_commands(program);
    core::write_file(folder / "man1/morsel.1", program_man_page(program.commands));
    for (const Command& command : program.commands)
      core::write_file(folder / "man1" / ("morsel-" + command.name + ".1"), command_man_page(command));
    core::write_file(folder / "bash/morsel", bash_completion(program.commands));
    core::write_file(folder / "zsh/_morsel", zsh_completion(program.commands));
    core::write_file(folder / "fish/morsel.fish", fish_completion(program.commands));
  } catch (const std::exception& error) {
    std::cerr << "morsel_manual: " << error.what() << "\n";
    return kWriteFailed;
  }
  return kDone;
}
