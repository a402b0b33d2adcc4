// morsel render: a picture of a surface, its field and its critical points.

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/drawing/png_comment.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/colormap.h"
#include "morsel/tools/render/picture.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest field;
  std::string output;
  render::PictureRequest picture;
  bool arcs = false;
  bool arcs_given = false;
  std::string size = "1200x900";
  render::CameraText camera;
  std::string background = "white";
  std::string range = "2%";
  std::string caption;
  std::string frame;
  std::string close_up;
};

int draw(const Options& options, const CommonOptions& common, Console& console) {
  render::PictureRequest request = options.picture;
  request.size = render::parse_size(options.size);
  request.transparent = options.background == "transparent";
  const bool segments = request.show != render::Show::field && request.show != render::Show::plain;
  request.arcs = options.arcs_given ? options.arcs : segments;
  render::parse_range(options.range, request.scale);
  if (!request.scale.colormap.empty()) const render::Colormap known(request.scale.colormap);
  options.camera.check();
  for (const std::string& region : {options.frame, options.close_up})
    if (!region.empty()) render::parse_inset(region);
  if (!options.close_up.empty() && !(options.frame.empty() && options.camera.inset.empty()))
    throw core::InvalidArgument("--close-up does not go with --inset or --frame");
  const FieldRecipe recipe = prepare(options.field);
  RunFiles()
      .reads("MESH", options.mesh)
      .reads_of_field(options.field.field)
      .writes("-o", options.output)
      .check();
  core::FileWriter file(options.output);

  const core::Progress progress = console.progress();
  const HashedMesh mesh = read_hashed_mesh(options.mesh, {.repair = common.repair}, progress);
  const core::LoadedMesh& loaded = mesh.loaded;
  const auto region = [&](const std::string& text) -> std::optional<render::Inset> {
    if (text.empty()) return std::nullopt;
    return render::find_inset(render::parse_inset(text), loaded);
  };
  request.inset = region(options.camera.inset);
  request.frame = region(options.frame);
  request.close_up = region(options.close_up);
  const MadeField made = make_field(recipe, loaded, progress);
  tell_target(made, console);
  Timings timings;
  const Measurement measurement = measure(made.field(), timings, progress);

  const render::Studio studio(loaded.mesh);
  const morse::CriticalPoints& points = measurement.critical_points;
  const std::string counts = render::counts_line(points.minima, points.saddles, points.maxima);
  render::Subject subject{made.field(), &measurement,
                          render::quantity_of(made.input.name, recipe.chain.steps.back().name),
                          options.caption};
  if (subject.caption == "auto") subject.caption = recipe.chain.name + "\n" + counts;
  const render::Image image =
      studio.take(studio.view(options.camera.view, options.camera.up, progress), subject, request, progress);
  const HashedFile input{options.mesh, mesh.sha256};
  Provenance provenance(common.command, request_section(options.field, common.repair),
                        {input, loaded, recipe, made});
  provenance.set("picture",
                 render::picture_section(request, options.camera, subject.caption, loaded.source.numbering));
  file.write(drawing::with_png_comment(render::encode_png(image), provenance.json()));
  file.commit();
  console.message(counts);
  console.message("picture: " + options.output);
  return kDone;
}

std::string colormaps() {
  std::string text;
  for (const std::string_view name : render::colormap_names()) text += " " + std::string(name);
  return text;
}

}  // namespace

void add_render(CLI::App& app, Invocation& invocation) {
  using render::ScaleRequest;
  using render::Show;
  auto options = std::make_shared<Options>();
  render::PictureRequest& picture = options->picture;
  CLI::App& command = *app.add_subcommand(
      "render",
      "Take a picture (PNG) of a surface coloured by a field or its segments, with critical points and arcs");
  add_field_options(command, options->mesh, options->field);
  command
      .add_option("--show", picture.show,
                  "What colours the surface: field, plain, or segments: descending (one a maximum),\n"
                  "ascending (one a minimum), morse-smale")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Show>{{"field", Show::field},
                                                                      {"plain", Show::plain},
                                                                      {"descending", Show::descending},
                                                                      {"ascending", Show::ascending},
                                                                      {"morse-smale", Show::morse_smale}}))
      ->type_name("WHAT")
      ->default_str("field");
  command.add_flag("--points,!--no-points", picture.points,
                   "Critical points as spheres: minima blue, saddles green, maxima red (default: yes)");
  const CLI::Option* arcs =
      command.add_flag("--arcs,!--no-arcs", options->arcs,
                       "The arcs of the Morse-Smale complex as tubes: descending blue, ascending red\n"
                       "(default: where segments are shown, and then only those that bound them)");
  command.add_option("--size", options->size, "Width and height in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  add_camera_options(command, options->camera);
  command
      .add_option("--frame", options->frame,
                  "Frame what lies within a radius (default 15eps) of a vertex: what --close-up shows")
      ->type_name("VERTEX[:RADIUS]");
  command
      .add_option("--close-up", options->close_up,
                  "Fill the picture with what lies within a radius (default 15eps) of a vertex")
      ->type_name("VERTEX[:RADIUS]");
  command.add_option("--samples", picture.samples, "Samples a pixel, 1 to 1024")
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--background", options->background, "white or transparent")
      ->check(CLI::IsMember({"white", "transparent"}))
      ->type_name("GROUND")
      ->capture_default_str();
  command
      .add_option("--colormap", picture.scale.colormap,
                  "One of" + colormaps() + " (default: blue-orange\nwith a centre, else sand)")
      ->type_name("NAME");
  command
      .add_option("--range", options->range,
                  "Values at the ends of the colours: LOW/HIGH, or the percentage of the vertices to cut\n"
                  "off at either end")
      ->type_name("RANGE")
      ->capture_default_str();
  command
      .add_option(
          "--center", picture.scale.center,
          "The value in the middle of the colours: zero, median, none (default: of a field of both signs\n"
          "zero, or the median where one sign is rare)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ScaleRequest::Center>{{"zero", ScaleRequest::Center::zero},
                                                      {"median", ScaleRequest::Center::median},
                                                      {"none", ScaleRequest::Center::none}}))
      ->type_name("CENTER");
  command.add_flag("--legend,!--no-legend", picture.legend, "The colour bar (default: yes)");
  command
      .add_option("--caption", options->caption, "Text below the picture; auto is the method and its counts")
      ->type_name("TEXT");
  command.add_option("-o,--output", options->output, "The picture")
      ->check(names_file())
      ->type_name("OUT.png")
      ->required();
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, arcs, &invocation] {
    options->arcs_given = arcs->count() > 0;
    invocation.action = [options, &invocation](Console& console) {
      return draw(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
