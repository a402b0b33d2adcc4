// morsel quads: from a field to an all-quad mesh.

#include <iostream>
#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/quads_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest field{"eigenfunction:index=40", "conventional", std::nullopt};
  QuadRequest quads;
  std::string output;
  std::string json;
};

int make(const Options& options, const CommonOptions& common, Console& console) {
  const FieldPlan recipe = prepare(options.field);
  const QuadPlan quads = prepare(options.quads);
  if (core::file_extension(options.output) != ".obj")
    throw core::InvalidArgument("quads are written as .obj, not to " + options.output);
  RunFiles()
      .reads("MESH", options.mesh)
      .reads_of_field(options.field.field)
      .writes("-o", options.output)
      .writes_document("--json", options.json)
      .check();
  { const core::FileWriter target(options.output); }  // one that cannot be written is told before the work
  DocumentTarget document(options.json);

  const core::Progress progress = console.progress();
  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, progress);
  const double load_seconds = load_watch.seconds();
  const MadeField made = make_field(recipe, input.loaded, progress);
  tell_made(made, console);
  const Quadrangulation result = quadrangulate(made.field(), quads, progress);
  const QuadsRequest request{options.field, options.quads, common.repair};
  const HashedFile file{options.mesh, input.sha256};
  const FieldSource source{file, input.loaded, recipe, made};
  const Provenance provenance(common.command, request_section(request), source);
  core::write_obj(options.output, result.mesh.positions, result.mesh.quads, provenance.lines(), progress);
  if (document.is_wanted())
    write_quads(document.json(), request, source, result,
                {{"load", load_seconds},
                 {"field", made.input.seconds},
                 {"method", made.method_seconds},
                 {"layout", result.layout_seconds},
                 {"sampling", result.sampling_seconds},
                 {"measuring", result.measuring_seconds}});
  document.commit();
  if (!document.is_stdout()) std::cout << described(result, input.loaded.mesh.bounding_box().diagonal());
  console.message("quads: " + options.output);
  if (document.is_file()) console.message("report: " + options.json);
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
            "Cancel pairs of at most this persistence before the layout: a number in the field's unit "
            "or a share of its extent (1%)")
      .value("T");
  command.number("--resolution", options->quads.resolution, "Quads along each side of a patch, 2 or more");
  command
      .number("--relaxation", options->quads.relaxation,
              "How often all corners of patches are moved to the middle of the patches around them; "
              "0 leaves them at the critical points")
      .value("R");
  command.path("-o,--output", options->output, "The quads: .obj").value("OUT.obj").required();
  command.path("--json", options->json,
               "Write counts, repairs and quality of the quads and patches here; - is standard output");
  add_common_options(command, program.common);
  command.examples = {
      {"quads scan.off -o quads.obj", "patches of 10 x 10 quads, laid out by the 40th eigenfunction"},
      {"quads scan.off --field eigenfunction:index=20 --resolution 16 -o quads.obj",
       "fewer and finer patches"}};
  command.notes =
      "Patches are the quads of the field's Morse-Smale complex, their arcs drawn anew as curves that meet "
      "in "
      "nodes alone. Smooth fields with evenly spread critical points give good layouts: eigenfunctions, the "
      "more patches the higher the index. At a boundary loop patches have five sides; there N must be 4 or "
      "more "
      "and even. An extremum with a single arc is cancelled with its saddle, and reported; a field that "
      "leaves a "
      "component without a saddle is refused.\n\n" +
      std::string(kSpecificationNotes);
  command.action = [options, &program](Console& console) { return make(*options, program.common, console); };
}

}  // namespace morsel::tools
