// morsel segment: the segments of one field.

#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/export/label_file.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/segments_writer.h"
#include "morsel/tools/study/made_segments.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request;
  std::string by = to_string(mscomplex::SegmentKind::descending);
  std::optional<std::size_t> segments;
  std::string persistence;
  std::string output;
  std::string json;
};

SegmentRequest segment_request(const Options& options) {
  SegmentRequest request;
  request.kind = parse_segment_kind(options.by);
  request.segments = options.segments;
  if (!options.persistence.empty())
    request.persistence = persistence::parse_threshold(options.persistence, "--persistence");
  check(request);
  return request;
}

std::string described(const MadeSegments& made) {
  const MadeSegments::Areas areas = made.areas();
  std::string text = "segments: " + grouped(made.segments.count());
  if (made.cancelled_pairs > 0)
    text += " of " + grouped(made.unmerged) + " (" + grouped(made.cancelled_pairs) +
            (made.cancelled_pairs == 1 ? " pair" : " pairs") + " cancelled, of persistence up to " +
            core::to_digits(made.largest_persistence) + ")";
  return text + "; area smallest " + core::to_digits(areas.smallest) + ", median " +
         core::to_digits(areas.median) + ", largest " + core::to_digits(areas.largest);
}

int segment(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  const FieldPlan recipe = prepare(options.request);
  const SegmentRequest request = segment_request(options);
  RunFiles files;
  files.reads("MESH", options.mesh).reads_of_field(options.request.field);
  for (const std::filesystem::path& file : label_files(options.output)) files.writes("-o", file);
  files.writes_document("--json", options.json).check();
  check_label_path(options.output);
  DocumentTarget document(options.json);

  const core::Progress progress = console.progress();
  Timings timings;
  const Stopwatch load_watch;
  const HashedWholeMesh mesh = read_hashed_whole_mesh(options.mesh, {.repair = common.repair}, progress);
  const core::LoadedMesh& loaded = mesh.input.loaded;
  timings.emplace_back("load", load_watch.seconds());

  const MadeField field = make_field(recipe, loaded, progress);
  timings.emplace_back("field", field.input.seconds);
  timings.emplace_back("method", field.method_seconds);
  tell_made(field, console);
  const Stopwatch segment_watch;
  const MadeSegments made = make_segments(field.field(), request, progress);
  timings.emplace_back("segments", segment_watch.seconds());

  const SegmentsRequest asked{options.request, request, common.repair};
  const HashedFile file{options.mesh, mesh.sha256};
  const FieldSource source{file, loaded, recipe, field};
  const Labels labels{"segment", made.segments.vertex, made.segments.triangle};
  const std::vector<std::filesystem::path> written =
      write_labels(options.output, labels, field.field(), field.input.name, loaded.source.numbering,
                   mesh.input.input_positions, {common.command, request_section(asked), source});
  if (document.is_wanted()) write_segments(document.json(), asked, source, made, timings);
  document.commit();
  console.message(described(made));
  if (!made.note.empty()) console.message(made.note);
  for (const std::filesystem::path& path : written) console.message("labels: " + path.string());
  if (document.is_file()) console.message("table: " + options.json);
  return kDone;
}

}  // namespace

void add_segment(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "segment", "Cut the surface into the segments of one field, small ones merged by persistence");
  add_field_options(command, options->mesh, options->request);
  command
      .text("--by", options->by,
            "descending (a segment for each maximum: the bumps of a curvature), ascending (for each "
            "minimum: with atomic-density, which is lowest where the surface bulges, too) or morse-smale "
            "(for each cell between a minimum and a maximum)")
      .value("KIND");
  command
      .number("--segments", options->segments,
              "Merge segments, those of least persistence first, until at most N are left")
      .between(1, std::numeric_limits<double>::infinity());
  command
      .text("--persistence", options->persistence,
            "Or: merge all of at most this persistence, in the field's unit or, as in 0.1%, in percent of "
            "its extent (default: merge nothing)")
      .value("T");
  command
      .path("-o,--output", options->output,
            "Labels of vertices and triangles, in the input's vertex numbers: .ply (int properties "
            "\"segment\"), .vtp (arrays \"segment\", and the field) or .txt (a label a line: "
            "OUT.vertices.txt, OUT.faces.txt)")
      .value("OUT")
      .required();
  command.path("--json", options->json,
               "Write a table of the segments here: area, critical points, neighbours, boundary length; - is "
               "standard output");
  add_common_options(command, program.common);
  command.examples = {
      {"segment scan.off --method salient --segments 40 -o parts.ply", "the 40 most persistent bumps"},
      {"segment protein.off --by ascending --persistence 1% -o parts.vtp --json parts.json",
       "all that stand out by more than 1 %, with a table"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) {
    return segment(*options, program.common, console);
  };
}

}  // namespace morsel::tools
