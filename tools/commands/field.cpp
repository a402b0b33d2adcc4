// morsel field: writes one field.

#include <memory>

#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/field_file.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request;
  std::string output;
};

int write(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.request, run);
  base.writes("-o", options.output, check_field_path).check_files();
  base.read_whole();
  base.make();
  write_field(options.output, base.field(), base.loaded().source.numbering, base.input_positions(),
              base.made().input.name, base.provenance(request_section(options.request, run.common.repair)));
  run.console.message("field: " + options.output);
  return kDone;
}

}  // namespace

void add_field(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add("field", "Write one scalar field, as it is or after a method");
  add_field_options(command, options->mesh, options->request);
  add_output_option(command, options->output,
                    ".txt (a value a line), .ply or .vtp (the surface with the values)")
      .shortly("The file to write")
      .in_detail("Vertices have the input's numbers");
  add_common_options(command, program.common);
  command.examples = {
      {"field scan.off -o curvature.txt", "the mean curvature of every vertex, a value a line"},
      {"field scan.off --field height:axis=z --method salient -o smooth.vtp",
       "the smoothed height on the surface, for ParaView"}};
  add_specification_notes(command);
  set_action(program, command, options, write);
}

}  // namespace morsel::tools
