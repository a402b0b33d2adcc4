// morsel reproduce: the paper's figures and table.

#include <iostream>
#include <memory>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/reproduce/reproduction.h"

namespace morsel::tools {
namespace {

int make_again(reproduce::Request request, const CommonOptions& common, Console& console) {
  request.repair = common.repair;
  const reproduce::Prepared prepared = reproduce::prepare(request);
  RunFiles files;
  for (const reproduce::MeshFile& file : prepared.files) files.reads("the mesh", file.path);
  files.fills("DIR", request.folder).check();
  const reproduce::Reproduction reproduction = reproduce::run(prepared, console.progress());
  for (std::size_t i = 0; i < prepared.files.size(); ++i)
    console.message(std::string(reproduce::models()[i].name) + ": " + prepared.files[i].path.string() +
                    (prepared.files[i].is_sample ? " (a sample mesh in its place)" : ""));
  std::cout << reproduce::table_text(reproduction);
  console.message("page: " + (request.folder / "index.html").string());
  return kDone;
}

}  // namespace

void add_reproduce(CLI::App& app, Invocation& invocation) {
  auto request = std::make_shared<reproduce::Request>();
  CLI::App& command = *app.add_subcommand(
      "reproduce",
      "Make the figures and the table of the paper \"Salient Critical Points for Meshes\" again: pictures\n"
      "(PNG), numbers (JSON, CSV) and one page (HTML) that holds them beside the paper's own");
  command.add_option("DIR", request->folder, "The folder to write to; made if it is not there")
      ->check(names_file())
      ->required();
  command
      .add_option(
          "--data", request->data,
          "Meshes of the paper's models: lion, squirrel and protein (.off, .obj, .ply or .stl), or names\n"
          "with one of these words (of the protein also 1bp2 or 2bp2) in them; sample meshes stand in\n"
          "for those that are not there")
      ->check(names_file())
      ->type_name("DIR");
  command
      .add_option("--meshes", request->samples,
                  "The sample meshes: lion-head.off, bunny00.off and retinal.off of CGAL's example data")
      ->check(names_file())
      ->envname("MORSEL_SAMPLES")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_option("--size", request->size, "Width and height of a panel in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command.add_option("--samples", request->pixel_samples, "Samples a pixel, 1 to 1024")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option(
          "--view", request->views,
          "Where pictures are taken from, as morsel render has it (default: best); with MODEL=, of one\n"
          "model: lion=160/10; may be given several times")
      ->type_name("[MODEL=]VIEW")
      ->allow_extra_args(false);
  command.add_option("--up", request->ups, "The axis that points up: x, y or z (default: y)")
      ->type_name("[MODEL=]AXIS")
      ->allow_extra_args(false);
  add_common_options(command, invocation.common);
  command.callback([request, &invocation] {
    invocation.action = [request, &invocation](Console& console) {
      return make_again(*request, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
