// morsel segment: the segments of one field.

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/residues_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/label_file.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/segments_writer.h"
#include "morsel/tools/study/made_segments.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request;
  mscomplex::SegmentKind by = mscomplex::SegmentKind::descending;
  std::optional<std::size_t> segments;
  std::string persistence;
  std::string output;
  std::string json;
  ResiduesOptions residues;
};

SegmentRequest segment_request(const Options& options) {
  SegmentRequest request;
  request.kind = options.by;
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

int segment(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.request, run);
  const SegmentsRequest request{options.request, segment_request(options), run.common.build};
  ResiduesRun residues(options.residues, run);
  const core::FileTarget output = output_target(options.output, run);
  const core::FileTarget json = output_target(options.json, run);
  for (const core::FileTarget& file : label_files(output)) base.writes("-o", file);
  residues.add_files(base);
  base.writes_document("--json", json).check_files();
  DocumentTarget document(json);

  base.read_whole();
  base.make();
  const Stopwatch watch;
  const MadeSegments made = make_segments(base.field(), request.segments, run.console.progress());
  const Timings timings = base.timings({{"segments", watch.seconds()}});
  if (residues.are_wanted()) {
    residues.read(base.field().mesh());
    residues.add_level(base.field().mesh(), made.segments.vertex, made.segments.triangle);
    Json asked = request_section(request);
    asked["residues"] = residues.request();
    residues.write(base.provenance(asked), false);  // first: names may not fit, and then nothing is told
  }

  const Labels labels{"segment", made.segments.vertex, made.segments.triangle};
  const std::vector<core::FileTarget> written =
      write_labels(output, labels, base.field(), base.made().input.name, base.loaded().source.numbering,
                   base.input_positions(), base.provenance(request_section(request)));
  if (document.is_wanted()) write_segments(document.json(), request, base.source(), made, timings);
  document.commit();
  run.console.message(described(made));
  if (!made.note.empty()) run.console.message(made.note);
  for (const core::FileTarget& file : written) tell_written("labels", file, run);
  document.tell("table", run);
  return kDone;
}

}  // namespace

void add_segment(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "segment", "Cut the surface into the segments of one field, small ones merged by persistence");
  add_field_options(command, options->mesh, options->request);
  using mscomplex::SegmentKind;
  std::vector<std::pair<std::string, SegmentKind>> kinds;
  for (const SegmentKind kind : mscomplex::kSegmentKinds) kinds.emplace_back(to_string(kind), kind);
  command.choice("--by", options->by, std::move(kinds), "descending, ascending or morse-smale")
      .value("KIND")
      .in_detail(
          "descending: a segment for each maximum, the bumps of a curvature; ascending: for each minimum, "
          "with atomic-density, which is lowest where the surface bulges, too; morse-smale: for each cell "
          "between a minimum and a maximum");
  command.number("--segments", options->segments, "Merge segments until at most N are left")
      .between(1, std::numeric_limits<double>::infinity())
      .in_detail("Those of least persistence first");
  command.text("--persistence", options->persistence, "Or: merge all of at most this persistence")
      .value("T")
      .shortly("Merge all of at most this persistence")
      .shows_default("none")
      .in_detail("In the field's unit or, as in 0.1%, in percent of its range");
  add_output_option(command, options->output, {{"ply", "vtp", "annot", "label.gii", "glb"}},
                    "Labels: .ply, .vtp, .txt, .annot, .label.gii or .glb")
      .in_detail(
          "In the input's vertex numbers: .ply (int properties \"segment\", and colours), .vtp (arrays "
          "\"segment\", and the field) or .txt (a label a line: OUT.vertices.txt, OUT.faces.txt); of "
          "vertices "
          "alone .annot (FreeSurfer) and .label.gii (GIFTI), with names and colours; .glb, for slides, web "
          "pages "
          "and Blender, has a colour for each segment");
  add_json_option(command, options->json, "Write a table of the segments here")
      .in_detail("It has area, critical points, neighbours and boundary length of each");
  add_residues_options(command, options->residues);
  add_common_options(command, program.common);
  command.examples = {
      {"segment scan.off --method salient --segments 40 -o parts.ply", "the 40 most persistent bumps"},
      {"segment protein.off --by ascending --persistence 1% -o parts.vtp --json parts.json",
       "all that stand out by more than 1 %, with a table"}};
  add_specification_notes(command);
  set_action(program, command, options, segment);
}

}  // namespace morsel::tools
