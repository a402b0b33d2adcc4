// morsel quads: from a field to an all-quad mesh.

#include <memory>
#include <optional>

#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/report/quads_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest field{kQuadField, "conventional", std::nullopt};
  QuadRequest quads;
  std::string output;
  std::string json;
};

void check_path(const core::FileTarget& target) {
  core::checked_extension(target, "quads are written", {".obj"});
}

int make(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.field, run);
  const QuadPlan quads = prepare(options.quads);
  const core::FileTarget output = output_target(options.output, run);
  const core::FileTarget json = output_target(options.json, run);
  base.writes("-o", output, check_path).writes_document("--json", json).check_files();
  DocumentTarget document(json);

  base.read();
  base.make();
  const core::Progress progress = run.console.progress();
  const Quadrangulation result = quadrangulate(base.field(), quads, progress);
  const QuadsRequest request{options.field, options.quads, run.common.build};
  core::write_obj(output, result.mesh.positions, result.mesh.quads,
                  base.provenance(request_section(request)).lines(), progress);
  if (document.is_wanted())
    write_quads(document.json(), request, base.source(), result,
                base.timings({{"layout", result.layout_seconds},
                              {"sampling", result.sampling_seconds},
                              {"measuring", result.measuring_seconds}}));
  document.commit();
  show(described(result, base.loaded().mesh.bounding_box().diagonal()), run);
  tell_written("quads", output, run);
  document.tell("report", run);
  return kDone;
}

}  // namespace

void add_quads(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command =
      program.add("quads", "Turn the Morse-Smale complex of a field into an all-quad mesh of the surface");
  add_field_options(command, options->mesh, options->field);
  command
      .text("--persistence", options->quads.persistence,
            "Cancel pairs of at most this persistence before the layout")
      .value("T")
      .in_detail("A number in the field's unit or a share of its range (1%)");
  command.number("--resolution", options->quads.resolution, "Quads along each side of a patch, 2 or more");
  command
      .number("--relaxation", options->quads.relaxation,
              "How often corners of patches are moved to the middle of these")
      .value("R")
      .in_detail("0 leaves them at the critical points");
  add_output_option(command, options->output, {{"obj"}}, "The quads: .obj").value("OUT.obj");
  add_json_option(command, options->json, "Write counts, repairs and quality here")
      .in_detail("Of the quads and of the patches");
  add_common_options(command, program.common);
  command.examples = {
      {"quads scan.off -o quads.obj", "patches of 10 x 10 quads, laid out by the 40th eigenfunction"},
      {"quads scan.off --field eigenfunction:index=20 --resolution 16 -o quads.obj",
       "fewer and finer patches"}};
  command.notes =
      "Smooth fields with evenly spread critical points give good layouts: eigenfunctions, the more patches "
      "the higher the index.\n\n";
  command.details =
      "Patches are the quads of the field's Morse-Smale complex, their arcs drawn anew as curves that meet "
      "in "
      "nodes alone. At a boundary loop patches have five sides; there N must be 4 or more and even. An "
      "extremum with a single arc is cancelled with its saddle, and reported; a field that leaves a "
      "component without a saddle is refused.\n\n";
  add_specification_notes(command);
  set_action(program, command, options, make);
}

}  // namespace morsel::tools
