// morsel render: a picture of a surface, its field and its critical points.

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/commands/output_check.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/formats/png_comment.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/colormap.h"
#include "morsel/tools/render/picture.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest field;
  std::string output;
  render::PictureRequest picture;
  std::optional<bool> arcs;
  std::string size = "1200x900";
  render::CameraText camera;
  std::string background = "white";
  std::string range = "2%";
  std::string caption;
  std::string frame;
  std::string close_up;
};

int draw(const Options& options, const CommonOptions& common, Console& console) {
  drawing::require_pictures("morsel render");
  render::PictureRequest request = options.picture;
  request.size = render::parse_size(options.size);
  request.transparent = options.background == "transparent";
  const bool segments = request.show != render::Show::field && request.show != render::Show::plain;
  request.arcs = options.arcs.value_or(segments);
  render::parse_range(options.range, request.scale);
  if (!request.scale.colormap.empty()) const render::Colormap known(request.scale.colormap);
  options.camera.check();
  for (const std::string& region : {options.frame, options.close_up})
    if (!region.empty()) render::parse_inset(region);
  if (!options.close_up.empty() && !(options.frame.empty() && options.camera.inset.empty()))
    throw core::InvalidArgument("--close-up does not go with --inset or --frame");
  const FieldPlan recipe = prepare(options.field);
  RunFiles()
      .reads("MESH", options.mesh)
      .reads_of_field(options.field.field)
      .writes("-o", options.output)
      .check();
  if (core::file_extension(options.output) != ".png")
    throw core::InvalidArgument("a picture is written to .png, not to \"" + options.output + "\"");
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
  tell_made(made, console);
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

void add_render(Program& program) {
  using render::ScaleRequest;
  using render::Show;
  auto options = std::make_shared<Options>();
  render::PictureRequest& picture = options->picture;
  Command& command = program.add(
      "render",
      "Take a picture (PNG) of a surface coloured by a field or its segments, with critical points and arcs");
  add_field_options(command, options->mesh, options->field);
  command
      .choice("--show", picture.show,
              std::vector<std::pair<std::string, Show>>{{"field", Show::field},
                                                        {"plain", Show::plain},
                                                        {"descending", Show::descending},
                                                        {"ascending", Show::ascending},
                                                        {"morse-smale", Show::morse_smale}},
              "What colours the surface: field, plain, or segments: descending (one a maximum), "
              "ascending (one a minimum), morse-smale")
      .value("WHAT");
  command
      .switches("--points", "--no-points", picture.points,
                "Critical points as spheres: minima blue, saddles green, maxima red")
      .shows_default("yes");
  command
      .switches("--arcs", "--no-arcs", options->arcs,
                "The arcs of the Morse-Smale complex as tubes: descending blue, ascending red")
      .shows_default("where segments are shown, and then only those that bound them");
  command.text("--size", options->size, "Width and height in pixels").value("WxH");
  add_camera_options(command, options->camera);
  command
      .text("--frame", options->frame,
            "Frame what lies within a radius (default 15eps) of a vertex: what --close-up shows")
      .value("VERTEX[:RADIUS]");
  command
      .text("--close-up", options->close_up,
            "Fill the picture with what lies within a radius (default 15eps) of a vertex")
      .value("VERTEX[:RADIUS]");
  command.number("--samples", picture.samples, "Samples a pixel, 1 to 1024").between(1, 1024);
  command.text("--background", options->background, "white or transparent")
      .among({"white", "transparent"})
      .value("GROUND");
  command
      .text("--colormap", picture.scale.colormap,
            "One of" + colormaps() + " (default: blue-orange with a centre, else sand)")
      .value("NAME");
  command
      .text("--range", options->range,
            "Values at the ends of the colours: LOW/HIGH, or the percentage of the vertices to cut "
            "off at either end")
      .value("RANGE");
  command
      .choice(
          "--center", picture.scale.center,
          std::vector<std::pair<std::string, ScaleRequest::Center>>{{"zero", ScaleRequest::Center::zero},
                                                                    {"median", ScaleRequest::Center::median},
                                                                    {"none", ScaleRequest::Center::none}},
          "The value in the middle of the colours: zero, median, none (default: of a field of both signs "
          "zero, or the median where one sign is rare)")
      .value("CENTER");
  command.switches("--legend", "--no-legend", picture.legend, "The colour bar").shows_default("yes");
  command.text("--caption", options->caption, "Text below the picture; auto is the method and its counts")
      .value("TEXT");
  command.path("-o,--output", options->output, "The picture").value("OUT.png").required();
  add_common_options(command, program.common);
  command.examples = {
      {"render scan.off --method salient -o points.png", "the curvature, and the points that salient leaves"},
      {"render scan.off --method salient --show descending --view 30/20 -o parts.png",
       "its segments, from the side"}};
  command.notes = kSpecificationNotes;
  command.action = [options, &program](Console& console) { return draw(*options, program.common, console); };
}

}  // namespace morsel::tools
