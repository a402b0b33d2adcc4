// morsel cut: opens a surface into discs.

#include <iostream>
#include <memory>
#include <optional>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/document_target.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/export/cut_files.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/report/cut_writer.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/study/cutting.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest request{"height:axis=z", "conventional", {}};
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

int cut(const Options& options, const CommonOptions& common, Console& console) {
  const FieldPlan recipe = prepare(options.request);
  check_cut_mesh_path(options.output);
  if (!options.graph.empty()) check_cut_graph_path(options.graph);
  RunFiles()
      .reads("MESH", options.mesh)
      .reads_of_field(options.request.field)
      .writes("-o", options.output)
      .writes_document("--json", options.json)
      .writes("--graph", options.graph)
      .check();
  // Unwritable targets are told before the work, not after it.
  DocumentTarget document(options.json);
  { const core::FileWriter probe(options.output); }
  if (!options.graph.empty()) const core::FileWriter probe(options.graph);

  const Stopwatch load_watch;
  const HashedMesh input = read_hashed_mesh(options.mesh, {.repair = common.repair}, console.progress());
  const double load_seconds = load_watch.seconds();
  const MadeField made = make_field(recipe, input.loaded, console.progress());
  tell_made(made, console);
  const CutOutcome outcome = cut_surface(made.field(), !options.no_shorten, console.progress());

  const Stopwatch write_watch;
  const CutRequest request{options.request, !options.no_shorten, common.repair};
  const HashedFile file{options.mesh, input.sha256};
  const FieldSource source{file, input.loaded, recipe, made};
  const Provenance provenance(common.command, request_section(request), source);
  write_cut_mesh(options.output, outcome.opened, input.loaded.source.numbering, provenance,
                 console.progress());
  if (!options.graph.empty()) write_cut_graph(options.graph, outcome.cut, input.loaded, provenance);
  if (document.is_wanted())
    write_cut_document(document.json(), request, source, outcome,
                       {{"load", load_seconds},
                        {"field", made.input.seconds},
                        {"method", made.method_seconds},
                        {"complex", outcome.complex_seconds},
                        {"cut", outcome.cut_seconds},
                        {"shorten", outcome.shorten_seconds},
                        {"open", outcome.open_seconds},
                        {"write", write_watch.seconds()}});
  document.commit();
  if (!document.is_stdout()) std::cout << table(outcome);
  if (!options.no_shorten && !outcome.is_settled)
    console.message("shortening ended before no path could be made shorter, after " +
                    std::to_string(outcome.attempts) + " attempts");
  console.message("cut mesh: " + options.output);
  if (document.is_file()) console.message("report: " + options.json);
  if (!options.graph.empty()) console.message("cut for ParaView: " + options.graph);
  return kDone;
}

}  // namespace

void add_cut(Program& program) {
  auto options = std::make_shared<Options>();
  Command& command = program.add(
      "cut", "Cut a surface of any genus open into one disc a component, along short paths of edges");
  add_field_options(command, options->mesh, options->request);
  command
      .path("-o,--output", options->output,
            "The mesh cut open, .off or .ply: vertices keep their numbers, copies come after them")
      .value("OUT")
      .required();
  command.flag("--no-shorten", options->no_shorten,
               "Cut along the complex's arcs as they are, which are longer");
  command.path("--json", options->json,
               "Write here what was cut and which vertices the copies copy; - is standard output");
  command.path("--graph", options->graph, "Write the cut as polylines here (.vtp, for ParaView)")
      .value("FILE.vtp");
  add_common_options(command, program.common);
  command.examples = {
      {"cut torus.off -o disc.off", "a disc with the same triangles"},
      {"cut torus.off -o disc.ply --graph cut.vtp", "the same, and the cut as lines for ParaView"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) { return cut(*options, program.common, console); };
}

}  // namespace morsel::tools
