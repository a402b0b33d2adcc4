// morsel points: a wanted number of critical points that stand out and lie apart.

#include <memory>

#include "morsel/core/io/file_extension.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/points_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/points_file.h"
#include "morsel/tools/report/points_writer.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request = {kPointsField, "conventional", {}};
  PointsOptions points = {.count = PointsRequest().count, .choice = {.fill = kFillField}};
  std::string output;
};

bool is_document(const core::FileTarget& output) {
  return (output.is_open_file() ? output.format : core::file_extension(output.path)) == ".json";
}

int choose(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.request, run);
  const PointsRequest request = *options.points.request();
  const PointsPlan plan = prepare(request);
  reads_of_points(base, request);
  const core::FileTarget output = output_target(options.output, run);
  const bool wants_document = is_document(output);
  if (wants_document)
    base.writes_document("-o", output);
  else
    base.writes("-o", output, check_points_path);
  base.check_files();
  DocumentTarget document(wants_document ? output : "");

  base.read();
  base.make();
  const MadePoints made = base.choose_points(plan);

  const Json asked = request_section(options.request, request, run.common.build);
  if (wants_document) {
    write_points_document(document.json(), asked, base.source(), made, base.timings());
    document.commit();
  } else {
    Provenance provenance = base.provenance(asked);
    if (made.fill) provenance.set_fill(*made.fill);
    write_points(output, made, base.source(), provenance);
  }
  tell_written("points", output, run);
  return kDone;
}

}  // namespace

void add_points(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command =
      program.add("points", "Choose critical points of one field that stand out and lie apart");
  add_field_options(command, options->mesh, options->request);
  add_points_options(command, options->points);
  command.begin_group("What is written");
  add_output_option(command, options->output, {{"json", "csv", "ply", "vtp", "glb"}, "json"},
                    ".csv, .json, .ply, .vtp or .glb; - is standard output")
      .shortly("The file to write")
      .in_detail(
          "Points come in the order in which they were chosen, vertices have the input's numbers; .glb, for "
          "slides, web pages and Blender, has the surface in the field's colours and the points on it");
  add_common_options(command, program.common);
  command.examples = {
      {"points bunny.off --points 50 -o points.csv", "50 points that people might mark"},
      {"points scan.off --field mean-curvature --method salient --kind maxima --rank salience "
       "--points 20 --spacing 3% -o bumps.vtp",
       "the 20 bumps that stand out most, for ParaView"}};
  add_specification_notes(command);
  set_action(program, command, options, choose);
}

}  // namespace morsel::tools
