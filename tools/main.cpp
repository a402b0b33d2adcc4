// The morsel program: reads the command line, runs one command, turns errors into exit codes.

#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/stop.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/signals.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/version.h"

namespace {

using namespace morsel;
using namespace morsel::tools;

int exit_code(core::ErrorKind kind) {
  switch (kind) {
    case core::ErrorKind::invalid_argument:
      return kWrongUsage;
    case core::ErrorKind::bad_input:
      return kBadInput;
    case core::ErrorKind::write_failed:
      return kWriteFailed;
    case core::ErrorKind::cancelled:
      return 128 + SignalWatch::received();
  }
  return kInternalError;
}

int fail(int code, const std::string& message) {
  std::cerr << "morsel: " << message << '\n';
  return code;
}

int run(int argc, char** argv, std::stop_token stop) {
  CLI::App app(
      "Critical points of scalar fields on triangle meshes, by several methods held against each other.",
      "morsel");
  app.set_version_flag("--version", std::string("morsel ") + kVersion);
  app.require_subcommand(1);
  app.footer(
      "morsel COMMAND --help tells about each command. Exit codes: 0 done, 1 a check found differences\n"
      "or a mesh of a batch failed, 2 wrong usage, 3 bad input, 4 writing failed, 5 out of memory, 130 and "
      "143 interrupted.");
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
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    return fail(kWrongUsage, std::string(error.what()) + " (morsel --help tells what is possible)");
  }
  const core::StopScope scope(stop);
  try {
    std::optional<core::ThreadLimit> limit;
    if (invocation.common.threads > 0) limit.emplace(invocation.common.threads);
    Console console(invocation.common.quiet, std::move(stop));
    const int code = invocation.action(console);
    std::cout.flush();
    if (!std::cout) return fail(kWriteFailed, "cannot write to standard output");
    return code;
  } catch (const core::Cancelled& error) {
    return fail(exit_code(error.kind()), "interrupted");
  } catch (const core::Error& error) {
    return fail(exit_code(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(kOutOfMemory, "out of memory");
  } catch (const std::exception& error) {
    return fail(kInternalError, std::string("internal error: ") + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const SignalWatch watch;
  return run(argc, argv, watch.token());
}
