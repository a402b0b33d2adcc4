// morsel cut: opens a surface into discs.

#include <memory>

#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/export/cut_files.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/cut_writer.h"
#include "morsel/tools/study/cutting.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request{kCutField, "conventional", {}};
  std::string output;
  bool no_shorten = false;
  std::string json;
  std::string graph;
};

/// A row a component, or all in one where there are many.
std::string table(const CutOutcome& outcome) {
  constexpr std::size_t kMostRows = 20;
  std::vector<std::vector<std::string>> rows = {
      {"component", "vertices", "genus", "loops", "paths", "found", "length", "copies"}};
  ComponentCut all;
  for (std::size_t c = 0; c < outcome.components.size(); ++c) {
    const ComponentCut& part = outcome.components[c];
    all.vertices += part.vertices;
    all.genus += part.genus;
    all.loops += part.loops;
    all.paths += part.paths;
    all.length_found += part.length_found;
    all.length += part.length;
    all.copies += part.copies;
    if (outcome.components.size() <= kMostRows)
      rows.push_back({std::to_string(c), grouped(part.vertices), grouped(part.genus), grouped(part.loops),
                      grouped(part.paths), core::to_digits(part.length_found), core::to_digits(part.length),
                      grouped(part.copies)});
  }
  if (outcome.components.size() > 1)
    rows.push_back({"all " + grouped(outcome.components.size()), grouped(all.vertices), grouped(all.genus),
                    grouped(all.loops), grouped(all.paths), core::to_digits(all.length_found),
                    core::to_digits(all.length), grouped(all.copies)});
  return text_table(rows);
}

int cut(const Options& options, const Run& run) {
  FieldRun base(options.mesh, options.request, run);
  const core::FileTarget output = output_target(options.output, run);
  const core::FileTarget json = output_target(options.json, run);
  const core::FileTarget graph = output_target(options.graph, run);
  base.writes("-o", output, check_cut_mesh_path)
      .writes_document("--json", json)
      .writes("--graph", graph, check_cut_graph_path)
      .check_files();
  DocumentTarget document(json);

  base.read();
  base.make();
  const core::Progress progress = run.console.progress();
  const CutOutcome outcome = cut_surface(base.field(), !options.no_shorten, progress);

  const Stopwatch write_watch;
  const CutRequest request{options.request, !options.no_shorten, run.common.build};
  const Provenance provenance = base.provenance(request_section(request));
  write_cut_mesh(output, outcome.opened, base.loaded().source.numbering, provenance, progress);
  if (!options.graph.empty()) write_cut_graph(graph, outcome.cut, base.loaded(), provenance);
  if (document.is_wanted())
    write_cut_document(document.json(), request, base.source(), outcome,
                       base.timings({{"complex", outcome.complex_seconds},
                                     {"cut", outcome.cut_seconds},
                                     {"shorten", outcome.shorten_seconds},
                                     {"open", outcome.open_seconds},
                                     {"write", write_watch.seconds()}}));
  document.commit();
  show(table(outcome), run);
  if (!options.no_shorten && !outcome.is_settled)
    run.console.message("shortening ended before no path could be made shorter, after " +
                        std::to_string(outcome.attempts) + " attempts");
  tell_written("cut mesh", output, run);
  document.tell("report", run);
  if (!options.graph.empty()) tell_written("cut for ParaView", graph, run);
  return kDone;
}

}  // namespace

void add_cut(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "cut", "Cut a surface of any genus open into one disc a component, along short paths of edges");
  add_field_options(command, options->mesh, options->request);
  add_output_option(command, options->output, {{"off", "ply"}}, "The mesh cut open, .off or .ply")
      .in_detail("Vertices keep their numbers, copies come after them");
  command.flag("--no-shorten", options->no_shorten,
               "Cut along the complex's arcs as they are, which are longer");
  add_json_option(command, options->json, "Write what was cut here")
      .in_detail("It lists, too, the vertex that each copy is of");
  command.output("--graph", options->graph, {{"vtp"}}, "Write the cut as polylines here (.vtp, for ParaView)")
      .value("FILE.vtp");
  add_common_options(command, program.common);
  command.examples = {
      {"cut torus.off -o disc.off", "a disc with the same triangles"},
      {"cut torus.off -o disc.ply --graph cut.vtp", "the same, and the cut as lines for ParaView"}};
  add_specification_notes(command);
  set_action(program, command, options, cut);
}

}  // namespace morsel::tools
