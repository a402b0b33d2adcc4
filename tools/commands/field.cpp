// morsel field: writes one field.

#include <memory>
#include <optional>

#include "morsel/core/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/comparison/comparison.h"
#include "morsel/tools/export/field_file.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  std::string field = "mean-curvature";
  std::string method = "conventional";
  std::optional<std::size_t> target;
  std::string output;
};

int write(const Options& options, const CommonOptions& common, Console& console) {
  const NamedFunction function = make_function(options.field);
  const MethodChain chain = make_method(options.method);
  check_field_path(options.output);
  const core::Progress progress = console.progress();
  core::LoadedSoup file = core::read_polygon_soup(options.mesh, progress);
  core::BuiltMesh built = core::build_mesh(file.soup, {.repair = common.repair});
  const core::LoadedMesh loaded{
      std::move(built.mesh),
      {std::move(built.numbering), std::move(file.properties), std::move(built.repairs)}};
  const FieldOutcome input = evaluate_field(loaded, function, progress);
  const ChainOutcome outcome =
      apply_chain(chain, loaded, function, input.field, {.target = options.target}, progress);
  if (outcome.target && !outcome.target->note.empty()) console.message(outcome.target->note);
  write_field(options.output, outcome.field, loaded.source.numbering, file.soup.positions, function.name);
  console.message("field: " + options.output);
  return kDone;
}

}  // namespace

void add_field(CLI::App& app, Invocation& invocation) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("field", "Write one scalar field, as it is or after a method");
  command.add_option("MESH", options->mesh, kMeshHelp)->required();
  command.add_option("--field", options->field, "Morse function (below)")
      ->type_name("F")
      ->capture_default_str();
  command.add_option("--method", options->method, "A method or chain of methods (below)")
      ->type_name("M")
      ->capture_default_str();
  add_target_option(command, options->target);
  command
      .add_option(
          "-o,--output", options->output,
          ".txt (a value a line), .ply or .vtp (the surface with the values), in the input's vertex numbers")
      ->type_name("OUT")
      ->required();
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, &invocation] {
    invocation.action = [options, &invocation](Console& console) {
      return write(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
