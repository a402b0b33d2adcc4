// morsel reproduce: the paper's figures and table.

#include <iostream>
#include <memory>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/report/output_check.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools {
namespace {

int make_again(reproduce::Request& request, const Run& run) {
  drawing::require_pictures("morsel reproduce");
  request.build = run.common.build;
  const reproduce::Prepared prepared = reproduce::prepare(request);
  RunFiles files;
  for (const reproduce::MeshFile& file : prepared.files)
    if (!file.is_made) files.reads_mesh_file("the mesh", file.path);
  files.fills("DIR", request.folder).check();
  const reproduce::Reproduction reproduction = reproduce::run(prepared, run.console.progress());
  for (std::size_t i = 0; i < prepared.files.size(); ++i)
    if (!prepared.files[i].is_made)
      run.console.message(std::string(reproduce::models()[i].name) + ": " + prepared.files[i].path.string() +
                          (prepared.files[i].is_sample ? " (a sample mesh in its place)" : ""));
  for (const auto& model : reproduction.models)
    for (const std::string& warning : model->loaded().source.warnings)
      run.console.warning(std::string(model->recipe().name) + ": " + warning);
  std::cout << reproduce::table_text(reproduction);
  run.console.message("page: " + (request.folder / "index.html").string());
  return kDone;
}

}  // namespace

void add_reproduce(Program& program) {
  auto request = std::make_shared<reproduce::Request>();
  Command& command =
      program.add("reproduce",
                  "Make the figures and the table of the paper \"Salient Critical Points for Meshes\" again");
  command.path("DIR", request->folder, "The folder to write to; made if it is not there").required();
  command.path("--data", request->data, "Meshes of the paper's models: lion, squirrel and protein")
      .value("DIR")
      .in_detail(
          core::mesh_extensions() +
          ", of these names or with one of these words (of the protein also 1bp2 or 2bp2) in them; sample "
          "meshes stand in for those that are not there");
  Option& samples =
      command.path("--meshes", request->samples, "The sample meshes, of CGAL's example data")
          .value("DIR")
          .in_detail("lion-head.off, bunny00.off and retinal.off; also by the variable MORSEL_SAMPLES");
  samples.environment = "MORSEL_SAMPLES";
  command.text("--size", request->size, "Width and height of a panel in pixels").value("WxH");
  command.number("--samples", request->pixel_samples, "Samples a pixel, 1 to 1024").between(1, 1024);
  command.texts("--view", request->views, "Where pictures are taken from; repeatable")
      .value("[MODEL=]VIEW")
      .shows_default("best")
      .in_detail(
          "As morsel render has it; with MODEL=, of one model: lion=160/10; may be given several times");
  command.texts("--up", request->ups, "The axis that points up: x, y or z")
      .value("[MODEL=]AXIS")
      .shows_default("y");
  add_common_options(command, program.common);
  command.examples = {{"reproduce paper", "with sample meshes in place of the paper's"},
                      {"reproduce paper --data models", "with the paper's own meshes, where they are there"}};
  command.notes =
      "DIR gets pictures (PNG), numbers (JSON, CSV) and one page (HTML) that holds them beside the paper's "
      "own.";
  set_action(program, command, request, make_again);
}

}  // namespace morsel::tools
