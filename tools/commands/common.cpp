#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/study/presets.h"

namespace morsel::tools {

void add_commands(Program& program) {
  add_compare(program);
  add_field(program);
  add_render(program);
  add_hierarchy(program);
  add_segment(program);
  add_cut(program);
  add_quads(program);
  add_stability(program);
  add_sweep(program);
  add_batch(program);
  add_check(program);
  add_reproduce(program);
  add_molecule(program);
  add_info(program);
  add_catalogue(program);
}

void add_common_options(Command& command, CommonOptions& common, bool with_repair) {
  command.number("--threads", common.threads, "Number of threads; never changes a result")
      .between(1, 4096)
      .shows_default("all");
  if (with_repair)
    command.flag("--repair", common.repair,
                 "Mend what breaks the mesh's rules (unreferenced vertices, degenerate and duplicate faces, "
                 "non-manifold edges and vertices, orientation) instead of refusing it");
  command.flag("--quiet", common.quiet, "No progress, no messages");
}

void add_target_option(Command& command, std::optional<std::size_t>& target) {
  command
      .number("--target", target,
              "End with so many critical points, or with the nearest smaller number that can be had: as much "
              "of the (last) method as leaves enough of them, persistence cancellation for the rest")
      .between(1, std::numeric_limits<double>::infinity())
      .value("K");
}

void add_field_options(Command& command, std::string& mesh, FieldRequest& request) {
  command.path("MESH", mesh, mesh_help()).required();
  command.text("--field", request.field, "Morse function").value("F");
  command.text("--method", request.method, "A method or chain of methods").value("M");
  add_target_option(command, request.target);
}

void add_camera_options(Command& command, render::CameraText& camera) {
  command
      .text("--view", camera.view,
            "Where pictures are taken from: best (shows most of the mesh saliency), front, back, left, "
            "right, top, bottom, or azimuth/elevation in degrees: 0/0 is the front, 90/0 the right")
      .value("VIEW");
  command
      .choice(
          "--up", camera.up,
          std::vector<std::pair<std::string, render::UpAxis>>{
              {"x", render::UpAxis::x}, {"y", render::UpAxis::y}, {"z", render::UpAxis::z}},
          "The axis that points up in pictures, x, y or z; the front is seen from +z (y up), -y (z up) or "
          "+y (x up)")
      .value("AXIS");
  command
      .text("--inset", camera.inset,
            "Magnify, in a corner of pictures, what lies within a radius (default 15eps) of a vertex")
      .value("VERTEX[:RADIUS]");
}

void add_methods_option(Command& command, std::vector<std::string>& methods) {
  command.texts("--method", methods, "A method or chain of methods; may be given several times").value("M");
}

namespace {

void add_preset_option(Command& command, ComparisonRequest& request) {
  Option row{"--preset", "Field and methods at once"};
  row.value_name = "WHICH";
  for (const Preset& preset : presets()) {
    row.choices.emplace_back(preset.name);
    row.help += (row.choices.size() == 1 ? ": " : "; ") + std::string(preset.name) + ", " +
                std::string(preset.purpose);
  }
  row.take = [&request](const Option&, const std::vector<std::string>& words) {
    apply_preset(words.back(), request);
  };
  command.add(std::move(row)).excludes("--field").excludes("--method");
}

}  // namespace

void add_comparison_options(Command& command, ComparisonRequest& request) {
  command.text("--field", request.field, "Morse function").value("F");
  add_methods_option(command, request.methods);
  add_preset_option(command, request);
  add_target_option(command, request.target);
  command.flag("--snap", request.snap,
               "Report each critical point at the position of the one of the input field that it came "
               "from (its origin)");
}

void add_figure_options(Command& command, render::FigureText& figure) {
  command.text("--size", figure.size, "Width and height of each method's picture in pixels").value("WxH");
  add_camera_options(command, figure.camera);
}

void tell_warnings(const FieldOutcome& field, Console& console) {
  for (const std::string& warning : field.warnings) console.warning(field.name + ": " + warning);
}

void tell_warnings(const std::vector<StepOutcome>& steps, Console& console) {
  for (const StepOutcome& step : steps)
    for (const std::string& warning : step.warnings) console.warning(step.name + ": " + warning);
}

void tell_made(const MadeField& made, Console& console) {
  tell_warnings(made.input, console);
  tell_warnings(made.outcome.steps, console);
  if (!made.outcome.target) return;
  for (const std::string& text : {made.outcome.target->note, early_end(*made.outcome.target)})
    if (!text.empty()) console.message(text);
}

std::string mesh_help() { return "Triangle mesh: " + core::mesh_extensions(); }

const char* const kSpecificationNotes =
    "F and M are written name or name:key=value,key=value; methods chain as M+M; a backslash keeps , : + = / "
    "literal. Lengths are in the mesh's unit, in eps (0.3 % of the bounding box's diagonal), in mean edges "
    "or in roots of the surface's area: 8eps, 3edges, 0.02rootarea. `morsel fields` and `morsel methods` "
    "list all names, `morsel methods salient` the keys of "
    "one.";

}  // namespace morsel::tools
