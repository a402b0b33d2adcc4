// morsel field: writes one field.

#include <memory>
#include <utility>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/export/field_file.h"
#include "morsel/tools/report/field_document.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request;
  std::string output;
};

int write(const Options& options, const CommonOptions& common, Console& console) {
  const FieldPlan recipe = prepare(options.request);
  RunFiles()
      .reads("MESH", options.mesh)
      .reads_of_field(options.request.field)
      .writes("-o", options.output)
      .check();
  check_field_path(options.output);
  const core::Progress progress = console.progress();
  const HashedWholeMesh mesh = read_hashed_whole_mesh(options.mesh, {.repair = common.repair}, progress);
  const core::LoadedMesh& loaded = mesh.input.loaded;
  const MadeField made = make_field(recipe, loaded, progress);
  tell_made(made, console);
  const HashedFile file{options.mesh, mesh.sha256};
  write_field(
      options.output, made.field(), loaded.source.numbering, mesh.input.input_positions, made.input.name,
      {common.command, request_section(options.request, common.repair), {file, loaded, recipe, made}});
  console.message("field: " + options.output);
  return kDone;
}

}  // namespace

void add_field(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add("field", "Write one scalar field, as it is or after a method");
  add_field_options(command, options->mesh, options->request);
  command
      .path(
          "-o,--output", options->output,
          ".txt (a value a line), .ply or .vtp (the surface with the values), in the input's vertex numbers")
      .value("OUT")
      .required();
  add_common_options(command, program.common);
  command.examples = {
      {"field scan.off -o curvature.txt", "the mean curvature of every vertex, a value a line"},
      {"field scan.off --field height:axis=z --method salient -o smooth.vtp",
       "the smoothed height on the surface, for ParaView"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) { return write(*options, program.common, console); };
}

}  // namespace morsel::tools
