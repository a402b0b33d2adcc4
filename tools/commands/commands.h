#pragma once
/// The commands of the program: each adds its table of options and says what to run.

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/tools/commands/command.h"
#include "morsel/tools/commands/console.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kDifferences = 1,  // or a mesh of a batch failed
  kWrongUsage = 2,
  kBadInput = 3,
  kWriteFailed = 4,
  kOutOfMemory = 5  // or out of threads, processes or open files
};

/// Options that every command takes.
struct CommonOptions {
  int threads = 0;                ///< 0: as many as the machine has
  core::BuildOptions build = {};  ///< of the commands that read a mesh
  bool quiet = false;
  std::string format;           ///< that MESH is read as; empty: its extension's
  std::string standard_output;  ///< the format, without dot, of the output that is -; empty: none is
  std::string command;          ///< the command line as a Provenance has it
};

/// The program: its commands, and the options that all of them take.
struct Program {
  CommonOptions common;
  std::deque<Command> commands;  // which stay where they are

  Command& add(std::string name, std::string summary) {
    return commands.emplace_back(std::move(name), std::move(summary));
  }
};

/// What an action is given besides its own options.
struct Run {
  const CommonOptions& common;
  Console& console;
};

/// All commands, in the order in which help lists them: made from the list in tools/CMakeLists.txt.
void add_commands(Program& program);

/// Sets the action: int action(Options&, const Run&).
template <class Options, class Action>
void set_action(Program& program, Command& command, std::shared_ptr<Options> options, Action action) {
  command.action = [&program, options = std::move(options), action](Console& console) {
    try {
      return action(*options, Run{program.common, console});
    } catch (const core::BadInput& error) {
      if (console.cause().empty()) throw;
      throw core::BadInput(std::string(error.what()) + "; the cause may be that " + console.cause());
    }
  };
}

/// --threads, --repair, --weld, --mask and --quiet, after the command's own.
void add_common_options(Command& command, CommonOptions& common, bool with_mesh = true);

/// --target K
Option& add_target_option(Command& command, std::optional<std::size_t>& target);
/// MESH, --field, --method and --target of the commands that work on one field.
void add_field_options(Command& command, std::string& mesh, FieldRequest& request);
/// --view, --up and --inset of the commands that take pictures.
void add_camera_options(Command& command, render::CameraText& camera);
/// --method, any number of times.
void add_methods_option(Command& command, std::vector<std::string>& methods);
/// --preset, which sets field and methods by a name. Where they depend on the wanted number of points it is
/// added after --target: options are taken in the order of the table.
void add_preset_option(Command& command, std::function<void(const std::string& name)> apply);
/// --field, --method, --target, --preset and --snap of the commands that run several methods.
void add_comparison_options(Command& command, ComparisonRequest& request);
/// --size and the camera options of a comparison's pictures, for a command that has --figures.
void add_figure_options(Command& command, render::FigureText& figure);
/// An output, which must be given: -o, --output; and --as where there is a choice of formats
Option& add_output_option(Command& command, std::string& output, OutputFormats formats, std::string help);
/// A document that may be wanted besides: --json
Option& add_json_option(Command& command, std::string& json, std::string help);

/// Texts that more than one command shows.
std::string mesh_help();
/// How Morse functions and methods are written.
void add_specification_notes(Command& command);

}  // namespace morsel::tools
