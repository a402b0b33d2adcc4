// The morsel program: reads the command line, runs one command, turns errors into exit codes.

#include <array>
#include <iostream>
#include <string>
#include <vector>

#include "morsel/core/parallel.h"
#include "morsel/core/printable.h"
#include "morsel/core/stop.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/failure.h"
#include "morsel/tools/commands/signals.h"
#include "morsel/tools/commands/threads.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/version.h"

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

/// Throws what the streams' errors throw.
int run(int argc, char** argv, std::stop_token stop) {
  std::cout.exceptions(std::ios::badbit | std::ios::failbit);
  CLI::App app(
      "Critical points of scalar fields on triangle meshes, by several methods held against each other.",
      "morsel");
  app.set_version_flag("--version", std::string("morsel ") + kVersion);
  app.require_subcommand(1);
  app.footer(
      "morsel COMMAND --help tells about each command. Exit codes: 0 done, 1 a check found differences\n"
      "or a mesh of a batch failed, 2 wrong usage, 3 bad input, 4 writing failed, 5 out of memory, "
      "threads or open files, 130 and 143 interrupted.");
  Invocation invocation;
  std::vector<std::string> words(argv, argv + argc);
  if (!words.empty()) words.front() = "morsel";
  invocation.common.command = shaping_command(words);
  add_compare(app, invocation);
  add_batch(app, invocation);
  add_field(app, invocation);
  add_hierarchy(app, invocation);
  add_info(app, invocation);
  add_check(app, invocation);
  add_molecule(app, invocation);
  add_segment(app, invocation);
  add_cut(app, invocation);
  add_quads(app, invocation);
  add_render(app, invocation);
  add_reproduce(app, invocation);
  add_stability(app, invocation);
  add_sweep(app, invocation);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      tell(core::printable(error.what()).c_str(), " (morsel --help tells what is possible)");
      return kWrongUsage;
    }
    app.exit(error);  // prints the help or the version
    std::cout.flush();
    return kDone;
  }
  const core::StopScope scope(stop);
  Console console(invocation.common.quiet, std::move(stop));
  limit_threads(invocation.common.threads, console);
  const int code = invocation.action(console);
  std::cout.flush();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  begin_main();
  try {
    const SignalWatch watch;
    return run(argc, argv, watch.token());
  } catch (...) {
    return tell_failure();
  }
}
