// morsel field: writes one field.

#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/points_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/field_file.h"
#include "morsel/tools/report/points_writer.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request;
  PointsOptions points;
  std::string output;
  std::string json;
};

/// Points that are wanted, and that only a document can hold.
void check_points(const Options& options, const core::FileTarget& output) {
  if (options.points.count && options.json.empty() && !holds_points(output))
    throw core::InvalidArgument(
        "a text or GIFTI file has the field's values alone: chosen points need --json, or " + options.output +
        " as .ply, .vtp or .glb");
}

int write(const Options& options, const Run& run) {
  const core::FileTarget output = output_target(options.output, run);
  FieldRun base(options.mesh, options.request, run);
  const std::optional<PointsRequest> request = options.points.request();
  std::optional<PointsPlan> plan;
  if (request) plan = prepare(*request);
  reads_of_points(base, request);
  const core::FileTarget json = output_target(options.json, run);
  base.writes("-o", output, check_field_path).writes_document("--json", json);
  check_points(options, output);
  base.check_files();
  DocumentTarget document(json);

  base.read_whole();
  base.make();
  std::optional<MadePoints> points;
  if (plan) points = base.choose_points(*plan);
  const Json asked = request_section(options.request, request, run.common.build);
  Provenance provenance = base.provenance(asked);
  if (points && points->fill) provenance.set_fill(*points->fill);
  if (document.is_wanted())
    write_points_document(document.json(), asked, base.source(), *points, base.timings());
  write_field(output, base.source(), base.input_positions(), provenance, points ? &*points : nullptr);
  document.commit();
  document.tell("points", run);
  tell_written("field", output, run);
  return kDone;
}

}  // namespace

void add_field(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add("field", "Write one scalar field, as it is or after a method");
  add_field_options(command, options->mesh, options->request);
  add_points_options(command, options->points);
  command.begin_group("What is written");
  add_output_option(
      command, options->output, {{"txt", "ply", "vtp", "glb", "shape.gii", "func.gii"}, "txt"},
      ".txt (a value a line), .ply or .vtp (with the surface), .glb, .shape.gii; - is standard output")
      .shortly("The file to write")
      .in_detail(
          "Vertices have the input's numbers; chosen points are marked, but in .txt and GIFTI (.shape.gii, "
          ".func.gii: values in single precision); .ply has colours, too; .glb, for slides, web pages and "
          "Blender, has the surface in colours and the chosen points or all critical points as spheres");
  add_json_option(command, options->json, "Write the chosen points here").needs("--points");
  add_common_options(command, program.common);
  command.examples = {
      {"field scan.off -o curvature.txt", "the mean curvature of every vertex, a value a line"},
      {"field scan.off --field height:axis=z --method salient -o smooth.vtp",
       "the smoothed height on the surface, for ParaView"},
      {"field scan.off --method salient --points 20 -o smooth.vtp --json points.json",
       "the smoothed curvature with 20 of its extrema"}};
  add_specification_notes(command);
  set_action(program, command, options, write);
}

}  // namespace morsel::tools
