// morsel hierarchy: critical points and complexes from fine to coarse.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/residues_options.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/hierarchy_export.h"
#include "morsel/tools/report/hierarchy_table.h"
#include "morsel/tools/report/hierarchy_writer.h"
#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  HierarchyRequest request;
  std::string output;
  bool no_items = false;
  std::string export_folder;
  ResiduesOptions residues;
  SegmentKind cells = SegmentKind::descending;
};

/// Says why a wanted number of critical points was not reached.
class TargetTeller : public HierarchySink {
 public:
  explicit TargetTeller(Console& console) : console_(console) {}
  void begin(const HierarchyBasis& basis) override { tell_made(basis.made, console_); }
  void level(const Level&) override {}

 private:
  Console& console_;
};

/// Finds the residues at the cells of each level.
class ResiduesSink : public HierarchySink {
 public:
  ResiduesSink(ResiduesRun& residues, SegmentKind cells) : residues_(residues), cells_(cells) {}
  void begin(const HierarchyBasis& basis) override { residues_.read(basis.made.field().mesh()); }
  void level(const Level& level) override {
    const mscomplex::SegmentLabels& labels = level.cells(cells_);
    residues_.add_level(level.field->mesh(), labels.vertex, labels.triangle);
  }

 private:
  ResiduesRun& residues_;
  SegmentKind cells_;
};

int make_hierarchy(const Options& options, const Run& run) {
  const HierarchyPlan prepared = prepare(options.request);
  const HierarchyRequest request = with_defaults(options.request);
  RunFiles files;
  files.reads_mesh(options.mesh, run.common.format).reads_mask(run.common.build);
  files.reads_of_field(request.field.field);
  ResiduesRun residues(options.residues, run);
  residues.add_files(files);
  const core::FileTarget output = output_target(options.output, run);
  files.writes_document("-o", output).fills("--export", options.export_folder).check();
  const std::unique_ptr<ResultFolder> folder = open_folder(options.export_folder, files, run);
  check_writable(residues.output());
  DocumentTarget document(output);

  const MeshInput input =
      read_input(options.mesh, std::span(&prepared.field.function, 1), run, !options.no_items);
  TargetTeller teller(run.console);
  HierarchyTable table(prepared);
  std::vector<HierarchySink*> sinks = {&teller, &table};
  std::optional<HierarchyWriter> writer;
  if (document.is_wanted())
    sinks.push_back(&writer.emplace(document.json(), input.loaded, input.about, request, prepared));
  ResiduesSink residues_sink(residues, options.cells);
  if (residues.are_wanted()) sinks.push_back(&residues_sink);
  std::optional<HierarchyExport> exports;
  if (folder)
    sinks.push_back(&exports.emplace(
        *folder, input.loaded,
        Provenance(run.common.command, request_section(request, input.about), {input.file()})));
  run_hierarchy(input.loaded, prepared, sinks, run.console.progress());
  if (writer) writer->finish();
  document.commit();

  show(table.text(), run);
  document.tell("hierarchy", run);
  if (exports) run.console.message("files for ParaView: " + options.export_folder);
  if (residues.are_wanted()) {
    Json asked = request_section(request, input.about);
    asked["residues"] = residues.request();
    asked["cells"] = to_string(options.cells);
    residues.write(Provenance(run.common.command, asked, {input.file()}), true);
  }
  return kDone;
}

}  // namespace

void add_hierarchy(Program& program) {
  auto options = std::make_shared<Options>();
  HierarchyRequest& request = options->request;
  Command& command = program.add(
      "hierarchy",
      "Critical points and Morse-Smale complexes of several levels, from fine to coarse, with the links "
      "between them");
  add_field_options(command, options->mesh, request.field);
  command.option("--method").shows_default("salient or, by persistence, conventional");
  command
      .choice("--by", request.kind,
              std::vector<std::pair<std::string, HierarchyKind>>{{"iteration", HierarchyKind::iteration},
                                                                 {"persistence", HierarchyKind::persistence}},
              "What makes levels: iteration (of the method) or persistence")
      .value("KIND")
      .in_detail(
          "iteration: what the (last) method's iterations make of the field; persistence: what cancelling "
          "pairs in its complex leaves");
  command.text("--levels", request.levels, "Iterations or thresholds of persistence")
      .value("L,L,...")
      .shows_default("1,5,10 or 0.1%,1%,5%")
      .in_detail(
          "By iteration their numbers, 0 being the method's input; by persistence thresholds, in the field's "
          "unit or in % of its range; in any order");
  command.text("--counts", request.counts, "By persistence: how many critical cells to leave")
      .value("N,N,...")
      .shortly("Numbers of critical cells to leave")
      .in_detail(
          "In place of thresholds; cells are minima, saddles with their multiplicities and maxima. Where a "
          "number cannot be had it is the nearest smaller one");
  command
      .output("-o,--output", options->output, {{"json"}},
              "Write levels and links here, as JSON; - is standard output")
      .value("LEVELS.json");
  command.flag("--no-items", options->no_items, "Leave what is listed one by one out of it; counts stay")
      .in_detail("That is: cancellations, and each level's critical points, arcs and cells");
  command
      .path("--export", options->export_folder,
            "Write each level's surface and complex (.vtp, for ParaView) here")
      .value("DIR")
      .shapes_nothing()
      .in_detail("surface.0.vtp is the finest level");
  add_residues_options(command, options->residues);
  std::vector<std::pair<std::string, SegmentKind>> kinds;
  for (const SegmentKind kind : mscomplex::kSegmentKinds) kinds.emplace_back(to_string(kind), kind);
  command
      .choice("--cells", options->cells, std::move(kinds),
              "Of which cells: descending, ascending or morse-smale")
      .value("KIND")
      .needs("--residues");
  add_common_options(command, program.common);
  command.examples = {{"hierarchy scan.off -o levels.json", "after 1, 5 and 10 iterations of salient"},
                      {"hierarchy scan.off --by persistence --counts 500,100,20 --export out",
                       "three simplified complexes, for ParaView"}};
  add_specification_notes(command);
  set_action(program, command, options, make_hierarchy);
}

}  // namespace morsel::tools
