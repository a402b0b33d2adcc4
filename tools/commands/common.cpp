#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/vertex_mask.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/study/presets.h"

namespace morsel::tools {
namespace {

bool takes_mesh(const Command& command) {
  return std::ranges::any_of(
      command.options(), [](const Option& row) { return row.is_called("MESH") || row.is_called("FILE"); });
}

void add_weld_option(Command& command, std::optional<core::Length>& weld) {
  Option row{"--weld", "First join vertices at the same position, or within a length"};
  row.value_name = "LENGTH";
  row.implied = "0";
  row.details =
      "As 0.01, 0.1eps, 0.01edges: in the order of their numbers each vertex joins the first within that "
      "length, whose position and values it gets; faces of which fewer than three corners are left go";
  row.take = [&weld](const Option& option, const std::vector<std::string>& words) {
    const core::Length length = core::parse_length(words.back(), option.names);
    if (length.value < 0) throw core::InvalidArgument(option.names + " must not be negative");
    weld = length;
  };
  command.add(std::move(row));
}

void add_mask_option(Command& command, std::optional<core::VertexValues>& mask) {
  Option row{"--mask", "Leave out vertices where the values in this file are 0 or nan"};
  row.value_name = "FILE";
  row.details =
      "Also file=FILE,column=NAME of a file with several columns, or property=NAME, a scalar of the mesh's "
      "own "
      "file; faces at these vertices go, and vertices that no face is left at";
  row.take = [&mask](const Option& option, const std::vector<std::string>& words) {
    mask = core::parse_vertex_values(words.back(), option.names);
  };
  command.add(std::move(row));
}

}  // namespace

void add_common_options(Command& command, CommonOptions& common, bool with_mesh) {
  command.begin_group("General");
  command.number("--threads", common.threads, "Number of threads; never changes a result")
      .between(1, 4096)
      .shows_default("all")
      .shapes_nothing();
  if (with_mesh) {
    command
        .flag("--repair", common.build.repair,
              "Repair what violates the mesh's rules, instead of refusing the mesh")
        .in_detail(
            "That is: unreferenced vertices, degenerate and duplicate faces, non-manifold edges and "
            "vertices, orientation");
    add_weld_option(command, common.build.weld);
    if (command.name != "reproduce") add_mask_option(command, common.build.mask);  // of several meshes
  }
  if (with_mesh && takes_mesh(command)) {
    command.text("--format", common.format, "Read the mesh as this, whatever its name; needed where it is -")
        .value("FORMAT")
        .among(core::mesh_format_names())
        .in_detail("The mesh - is standard input; a compressed file is read as what it holds");
    if (command.name != "info")
      for (const char* option : {"--repair", "--weld", "--mask", "--format"})
        command.option(option).told_by = "info";
  }
  command.flag("--quiet", common.quiet, "No progress, no messages, no warnings").shapes_nothing();
}

Option& add_target_option(Command& command, std::optional<std::size_t>& target) {
  return command.number("--target", target, "End with K critical points, or a smaller number and the reason")
      .between(1, std::numeric_limits<double>::infinity())
      .value("K")
      .in_detail(
          "As much of the (last) method as leaves enough of them, persistence cancellation for the rest; the "
          "number is smaller where K cannot be had");
}

void add_field_options(Command& command, std::string& mesh, FieldRequest& request) {
  command.path("MESH", mesh, mesh_help()).required();
  command.text("--field", request.field, "Morse function").is_function();
  command.text("--method", request.method, "A method or chain of methods").is_method();
  add_target_option(command, request.target);
}

void add_camera_options(Command& command, render::CameraText& camera) {
  command.text("--view", camera.view, "best, front, back, left, right, top, bottom or azimuth/elevation")
      .value("VIEW")
      .in_detail(
          "Where pictures are taken from: best shows most of the mesh saliency; azimuth and elevation are in "
          "degrees: 0/0 is the front, 90/0 the right");
  command
      .choice("--up", camera.up, {render::UpAxis::x, render::UpAxis::y, render::UpAxis::z},
              "The axis that points up in pictures: x, y or z")
      .value("AXIS")
      .in_detail("The front is seen from +z (y up), -y (z up) or +y (x up)");
  command.text("--inset", camera.inset, "Magnify a vertex and what is around it, in a corner of pictures")
      .value("VERTEX[:RADIUS]")
      .in_detail("The radius is 15eps if it is not given");
}

void add_methods_option(Command& command, std::vector<std::string>& methods) {
  command.texts("--method", methods, "A method or chain; repeatable")
      .is_method()
      .in_detail("May be given several times; what is given replaces the default");
}

void add_preset_option(Command& command, std::function<void(const std::string& name)> apply) {
  Option row{"--preset", "Field and methods at once"};
  row.value_name = "WHICH";
  for (const Preset& preset : presets()) {
    row.choices.emplace_back(preset.name);
    row.help += (row.choices.size() == 1 ? ": " : ", ") + std::string(preset.name);
    row.details +=
        (row.choices.size() == 1 ? "" : "; ") + std::string(preset.name) + ": " + std::string(preset.purpose);
  }
  row.take = [apply = std::move(apply)](const Option&, const std::vector<std::string>& words) {
    apply(words.back());
  };
  command.add(std::move(row)).excludes("--field").excludes("--method");
}

void add_comparison_options(Command& command, ComparisonRequest& request) {
  command.text("--field", request.field, "Morse function").is_function();
  add_methods_option(command, request.methods);
  add_target_option(command, request.target);
  add_preset_option(command, [&request](const std::string& name) { apply_preset(name, request); });
  command.flag("--snap", request.snap, "Report each critical point at its origin")
      .in_detail(
          "Its position is that of the critical point of the input field that it came from, its origin");
}

void add_figure_options(Command& command, render::FigureText& figure) {
  command.text("--size", figure.size, "Width and height of each method's picture in pixels")
      .value("WxH")
      .needs("--figures");
  add_camera_options(command, figure.camera);
  command.option("--inset").needs("--figures");
}

Option& add_output_option(Command& command, std::string& output, OutputFormats formats, std::string help) {
  return command.output("-o,--output", output, std::move(formats), std::move(help)).value("OUT").required();
}

Option& add_json_option(Command& command, std::string& json, std::string help) {
  return command.output("--json", json, {{"json"}}, std::move(help) + "; - is standard output");
}

std::string mesh_help() { return "Triangle mesh: .off, .obj, .ply, … (all: morsel info --help); or -"; }

void add_specification_notes(Command& command) {
  command.notes +=
      "F and M are written name or name:key=value,key=value; methods chain as M+M. Lengths are in the mesh's "
      "unit or as in 8eps (eps: 0.3 % of the bounding box's diagonal), 5% (of it), 3edges (mean ones) and "
      "0.02rootarea. `morsel fields` and `morsel methods` list names and keys.";
  command.details += "A backslash keeps , : + = / in names and values literal.";
}

}  // namespace morsel::tools
