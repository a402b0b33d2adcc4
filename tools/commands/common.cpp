#include <map>
#include <string>

#include "morsel/tools/commands/commands.h"
#include "morsel/tools/registry/registry.h"

namespace morsel::tools {

CLI::Validator names_file() {
  return {[](std::string& path) { return path.empty() ? std::string("'' names no file") : std::string(); },
          ""};
}

void add_common_options(CLI::App& command, CommonOptions& common, bool with_repair) {
  command.add_option("--threads", common.threads, "Number of threads (default: all); never changes a result")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  if (with_repair)
    command.add_flag(
        "--repair", common.repair,
        "Mend what breaks the mesh's rules (unreferenced vertices, degenerate and duplicate faces,\n"
        "non-manifold edges and vertices, orientation) instead of refusing it");
  command.add_flag("--quiet", common.quiet, "No progress, no messages");
}

void add_target_option(CLI::App& command, std::optional<std::size_t>& target) {
  command
      .add_option(
          "--target", target,
          "End with so many critical points, or with the nearest smaller number that can be had: as much\n"
          "of the (last) method as leaves enough of them, persistence cancellation for the rest")
      ->check(CLI::PositiveNumber)
      ->type_name("K");
}

void add_field_options(CLI::App& command, std::string& mesh, FieldRequest& request) {
  command.add_option("MESH", mesh, kMeshHelp)->check(names_file())->required();
  command.add_option("--field", request.field, "Morse function (below)")
      ->type_name("F")
      ->capture_default_str();
  command.add_option("--method", request.method, "A method or chain of methods (below)")
      ->type_name("M")
      ->capture_default_str();
  add_target_option(command, request.target);
}

void add_camera_options(CLI::App& command, render::CameraText& camera) {
  command
      .add_option(
          "--view", camera.view,
          "Where pictures are taken from: best (shows most of the mesh saliency), front, back, left,\n"
          "right, top, bottom, or azimuth/elevation in degrees: 0/0 is the front, 90/0 the right")
      ->type_name("VIEW")
      ->capture_default_str();
  command
      .add_option(
          "--up", camera.up,
          "The axis that points up in pictures; the front is seen from +z (y up), -y (z up) or +y (x up)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, render::UpAxis>{
          {"x", render::UpAxis::x}, {"y", render::UpAxis::y}, {"z", render::UpAxis::z}}))
      ->type_name("AXIS")
      ->default_str("y");
  command
      .add_option("--inset", camera.inset,
                  "Magnify, in a corner of pictures, what lies within a radius (default 15eps) of a vertex")
      ->type_name("VERTEX[:RADIUS]");
}

void add_methods_option(CLI::App& command, std::vector<std::string>& methods) {
  command
      .add_option("--method", methods,
                  "A method or chain of methods (below); may be given several times\n"
                  "(default: conventional, salient and tps)")
      ->type_name("M")
      ->allow_extra_args(false);
}

void add_comparison_options(CLI::App& command, ComparisonRequest& request) {
  command.add_option("--field", request.field, "Morse function (below)")
      ->type_name("F")
      ->capture_default_str();
  add_methods_option(command, request.methods);
  add_target_option(command, request.target);
  command.add_flag("--snap", request.snap,
                   "Report each critical point at the position of the one of the input field that it came\n"
                   "from (its origin)");
}

void add_figure_options(CLI::App& command, render::FigureText& figure) {
  command.add_option("--size", figure.size, "Width and height of each method's picture in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  add_camera_options(command, figure.camera);
}

void tell_target(const MadeField& made, Console& console) {
  if (made.outcome.target && !made.outcome.target->note.empty()) console.message(made.outcome.target->note);
}

std::string specification_help() {
  return "\nF and M are written name or name:key=value,key=value; methods chain as M+M; a backslash keeps , "
         ": + = /\n"
         "literal. Lengths are in the mesh's unit or in eps (0.3 % of the bounding box's diagonal): 8eps.\n"
         "\nMorse functions F, with their keys and defaults:\n" +
         describe_functions() + "\nMethods M, with their keys and defaults:\n" + describe_methods();
}

}  // namespace morsel::tools
