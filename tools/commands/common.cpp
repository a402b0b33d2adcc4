#include "morsel/tools/commands/commands.h"
#include "morsel/tools/registry/registry.h"

namespace morsel::tools {

void add_common_options(CLI::App& command, CommonOptions& common, bool with_repair) {
  command.add_option("--threads", common.threads, "Number of threads (default: all); never changes a result")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  if (with_repair)
    command.add_flag(
        "--repair", common.repair,
        "Mend what breaks the mesh's rules (unreferenced vertices, degenerate and duplicate faces,\n"
        "non-manifold edges and vertices, orientation) instead of refusing it");
  command.add_flag("--quiet", common.quiet, "No progress, no messages");
}

void add_target_option(CLI::App& command, std::optional<std::size_t>& target) {
  command
      .add_option(
          "--target", target,
          "End with so many critical points, or with the nearest smaller number that can be had: as much\n"
          "of the (last) method as leaves enough of them, persistence cancellation for the rest")
      ->check(CLI::PositiveNumber)
      ->type_name("K");
}

std::string specification_help() {
  return "\nF and M are written name or name:key=value,key=value; methods chain as M+M; a backslash keeps , "
         ": + = /\n"
         "literal. Lengths are in the mesh's unit or in eps (0.3 % of the bounding box's diagonal): 8eps.\n"
         "\nMorse functions F, with their keys and defaults:\n" +
         describe_functions() + "\nMethods M, with their keys and defaults:\n" + describe_methods();
}

}  // namespace morsel::tools
