#pragma once
/// The commands of the program: each adds itself to the parser and says what to run.

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "morsel/core/parallel.h"
#include "morsel/tools/commands/console.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/render/request_text.h"

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

/// What a chosen command runs; returns the exit code.
using Action = std::function<int(Console&)>;

/// The command that the arguments chose.
struct Invocation {
  CommonOptions common;
  Action action;
};

/// Of an option that names a file or folder: '' names none, and is refused.
CLI::Validator names_file();

void add_common_options(CLI::App& command, CommonOptions& common, bool with_repair = true);

/// --target K
void add_target_option(CLI::App& command, std::optional<std::size_t>& target);

/// MESH, --field, --method and --target of the commands that work on one field.
void add_field_options(CLI::App& command, std::string& mesh, FieldRequest& request);
/// --view, --up and --inset of the commands that take pictures.
void add_camera_options(CLI::App& command, render::CameraText& camera);
/// --method, any number of times.
void add_methods_option(CLI::App& command, std::vector<std::string>& methods);
/// --field, --method, --target and --snap of the commands that run several methods.
void add_comparison_options(CLI::App& command, ComparisonRequest& request);
/// --size and the camera options of a comparison's pictures.
void add_figure_options(CLI::App& command, render::FigureText& figure);
/// Says why a wanted number of critical points was not reached.
void tell_target(const MadeField& made, Console& console);

void add_batch(CLI::App& app, Invocation& invocation);
void add_compare(CLI::App& app, Invocation& invocation);
void add_field(CLI::App& app, Invocation& invocation);
void add_hierarchy(CLI::App& app, Invocation& invocation);
void add_info(CLI::App& app, Invocation& invocation);
void add_check(CLI::App& app, Invocation& invocation);
void add_molecule(CLI::App& app, Invocation& invocation);
void add_segment(CLI::App& app, Invocation& invocation);
void add_cut(CLI::App& app, Invocation& invocation);
void add_quads(CLI::App& app, Invocation& invocation);
void add_render(CLI::App& app, Invocation& invocation);
void add_reproduce(CLI::App& app, Invocation& invocation);
void add_stability(CLI::App& app, Invocation& invocation);
void add_sweep(CLI::App& app, Invocation& invocation);

/// Help texts that more than one command shows.
std::string specification_help();
inline constexpr const char* kMeshHelp = "Triangle mesh: .off, .obj, .ply or .stl";

}  // namespace morsel::tools
