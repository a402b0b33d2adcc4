#pragma once
/// The commands of the program: each adds its table of options and says what to run.

#include <cstddef>
#include <deque>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/parallel/parallel.h"
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
  int threads = 0;  ///< 0: as many as the machine has
  bool repair = false;
  bool quiet = false;
  std::string command;  ///< the command line as a Provenance has it
};

/// The program: its commands, and the options that all of them take.
struct Program {
  CommonOptions common;
  std::deque<Command> commands;  // which stay where they are

  Command& add(std::string name, std::string summary) {
    return commands.emplace_back(std::move(name), std::move(summary));
  }
};

/// All commands, in the order in which help lists them. A new one is a file and a line there.
void add_commands(Program& program);

void add_common_options(Command& command, CommonOptions& common, bool with_repair = true);

/// --target K
void add_target_option(Command& command, std::optional<std::size_t>& target);

/// MESH, --field, --method and --target of the commands that work on one field.
void add_field_options(Command& command, std::string& mesh, FieldRequest& request);
/// --view, --up and --inset of the commands that take pictures.
void add_camera_options(Command& command, render::CameraText& camera);
/// --method, any number of times.
void add_methods_option(Command& command, std::vector<std::string>& methods);
/// --field, --method, --preset, --target and --snap of the commands that run several methods.
void add_comparison_options(Command& command, ComparisonRequest& request);
/// --size and the camera options of a comparison's pictures.
void add_figure_options(Command& command, render::FigureText& figure);
/// Warnings of a Morse function, and of methods.
void tell_warnings(const FieldOutcome& field, Console& console);
void tell_warnings(const std::vector<StepOutcome>& steps, Console& console);
/// Warnings, why a wanted number of critical points was not reached, and whether iterations were left out for
/// it.
void tell_made(const MadeField& made, Console& console);

void add_batch(Program& program);
void add_catalogue(Program& program);
void add_compare(Program& program);
void add_field(Program& program);
void add_hierarchy(Program& program);
void add_info(Program& program);
void add_check(Program& program);
void add_molecule(Program& program);
void add_segment(Program& program);
void add_cut(Program& program);
void add_quads(Program& program);
void add_render(Program& program);
void add_reproduce(Program& program);
void add_stability(Program& program);
void add_sweep(Program& program);

/// Texts that more than one command shows.
extern const char* const kSpecificationNotes;
std::string mesh_help();

}  // namespace morsel::tools
