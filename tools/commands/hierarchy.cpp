// morsel hierarchy: critical points and complexes from fine to coarse.

#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/export/hierarchy_export.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/hierarchy_table.h"
#include "morsel/tools/report/hierarchy_writer.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/hierarchy.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  HierarchyRequest request;
  std::string output;
  bool no_items = false;
  std::string export_folder;
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

int make_hierarchy(const Options& options, const CommonOptions& common, Console& console) {
  // Wrong names and unwritable targets are told before the work, not after it.
  const HierarchyPlan prepared = prepare(options.request);
  const HierarchyRequest request = with_defaults(options.request);
  RunFiles files;
  files.reads("MESH", options.mesh).reads_of_field(request.field.field);
  files.writes_document("-o", options.output).fills("--export", options.export_folder).check();
  std::optional<ResultFolder> folder;
  if (!options.export_folder.empty())
    folder.emplace(options.export_folder, ResultFolder::Options{files.outputs(), console.stop_token()});
  DocumentTarget document(options.output);

  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, console.progress());
  const core::LoadedMesh& loaded = input.loaded;
  const ReportInput about{options.mesh, input.sha256, common.repair, !options.no_items, load_watch.seconds()};

  TargetTeller teller(console);
  HierarchyTable table(prepared);
  std::vector<HierarchySink*> sinks = {&teller, &table};
  std::optional<HierarchyWriter> writer;
  if (document.is_wanted()) {
    writer.emplace(document.json(), loaded, about, request, prepared);
    sinks.push_back(&*writer);
  }
  std::optional<HierarchyExport> exports;
  if (folder) {
    exports.emplace(
        *folder, loaded,
        Provenance(common.command, request_section(request, about), {{options.mesh, input.sha256}}));
    sinks.push_back(&*exports);
  }
  run_hierarchy(loaded, prepared, sinks, console.progress());
  if (writer) writer->finish();
  document.commit();

  if (!document.is_stdout()) std::cout << table.text();
  if (document.is_file()) console.message("hierarchy: " + options.output);
  if (exports) console.message("files for ParaView: " + options.export_folder);
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
  command.option("--method").shows_default("salient by iteration, conventional by persistence");
  command
      .choice("--by", request.kind,
              std::vector<std::pair<std::string, HierarchyKind>>{{"iteration", HierarchyKind::iteration},
                                                                 {"persistence", HierarchyKind::persistence}},
              "iteration: what the (last) method's iterations make of the field; "
              "persistence: what cancelling pairs in its complex leaves")
      .value("KIND");
  command
      .text("--levels", request.levels,
            "By iteration their numbers, 0 being the method's input (default: 1,5,10); by persistence "
            "thresholds, in the field's unit or in % of its extent (default: 0.1%,1%,5%); in any order")
      .value("L,L,...");
  command
      .text("--counts", request.counts,
            "By persistence, in place of thresholds: critical cells to be left (minima, saddles with "
            "their multiplicities, maxima), or the nearest smaller number that can be had")
      .value("N,N,...");
  command
      .path("-o,--output", options->output,
            "Write the levels and their links here, as JSON; - is standard output")
      .value("HIERARCHY.json");
  command.flag("--no-items", options->no_items,
               "Leave what is listed one by one out of the document: cancellations, and each level's "
               "critical points, arcs and cells; their counts stay");
  command
      .path("--export", options->export_folder,
            "Write each level's surface and complex (.vtp, for ParaView) here: surface.0.vtp is the "
            "finest level")
      .value("DIR");
  add_common_options(command, program.common);
  command.examples = {{"hierarchy scan.off -o levels.json", "after 1, 5 and 10 iterations of salient"},
                      {"hierarchy scan.off --by persistence --counts 500,100,20 --export out",
                       "three simplified complexes, for ParaView"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) {
    return make_hierarchy(*options, program.common, console);
  };
}

}  // namespace morsel::tools
