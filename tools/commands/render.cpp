// morsel render: a picture of a surface, its field and its critical points.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/text/listed.h"
#include "morsel/tools/color/colormap.h"
#include "morsel/tools/commands/steps.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/formats/png_comment.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/picture.h"
#include "morsel/tools/render/request_text.h"

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
  std::string range = "2%";
  std::string caption;
  std::string frame;
  std::string close_up;
};

void check_path(const core::FileTarget& target) {
  core::checked_extension(target, "a picture is written", {".png"});
}

int draw(const Options& options, const Run& run) {
  drawing::require_pictures("morsel render");
  render::PictureRequest request = options.picture;
  request.size = render::parse_size(options.size);
  const bool segments = request.show != render::Show::field && request.show != render::Show::plain;
  request.arcs = options.arcs.value_or(segments);
  parse_range(options.range, request.scale);
  options.camera.check();
  for (const std::string& region : {options.frame, options.close_up})
    if (!region.empty()) render::parse_inset(region);
  if (!options.close_up.empty() && !(options.frame.empty() && options.camera.inset.empty()))
    throw core::InvalidArgument("--close-up does not go with --inset or --frame");
  FieldRun base(options.mesh, options.field, run);
  const core::FileTarget output = output_target(options.output, run);
  base.writes("-o", output, check_path).check_files();

  base.read();
  const core::LoadedMesh& loaded = base.loaded();
  const auto region = [&](const std::string& text) -> std::optional<render::Inset> {
    if (text.empty()) return std::nullopt;
    return render::find_inset(render::parse_inset(text), loaded);
  };
  request.inset = region(options.camera.inset);
  request.frame = region(options.frame);
  request.close_up = region(options.close_up);
  base.make();
  const core::Progress progress = run.console.progress();
  Timings timings;
  const Measurement measurement = measure(base.field(), timings, progress);

  const render::Studio studio(loaded.mesh);
  const morse::CriticalPoints& points = measurement.critical_points;
  const std::string counts = render::counts_line(points.minima, points.saddles, points.maxima);
  const MethodChain& chain = base.plan().chain;
  render::Subject subject{
      base.field(), &measurement,
      render::quantity_of(base.made().input.name, base.made().input.unit, chain.quantity()), options.caption};
  if (subject.caption == "auto") subject.caption = chain.name + "\n" + counts;
  const render::Image image =
      studio.take(studio.view(options.camera.view, options.camera.up, progress), subject, request, progress);
  Provenance provenance = base.provenance(request_section(options.field, run.common.build));
  provenance.set("picture",
                 render::picture_section(request, options.camera, subject.caption, loaded.source.numbering));
  core::write_file(output, drawing::with_png_comment(render::encode_png(image), provenance.json()));
  run.console.message(counts);
  tell_written("picture", output, run);
  return kDone;
}

}  // namespace

void add_render(Program& program) {
  using render::Show;
  auto options = std::make_shared<Options>();
  render::PictureRequest& picture = options->picture;
  Command& command = program.add(
      "render",
      "Take a picture of a surface coloured by a field or its segments, with critical points and arcs (PNG)");
  add_field_options(command, options->mesh, options->field);
  add_output_option(command, options->output, {{"png"}}, "The picture").value("OUT.png");

  command.begin_group("What it shows");
  command
      .choice("--show", picture.show,
              std::vector<std::pair<std::string, Show>>{{"field", Show::field},
                                                        {"plain", Show::plain},
                                                        {"descending", Show::descending},
                                                        {"ascending", Show::ascending},
                                                        {"morse-smale", Show::morse_smale}},
              "field, plain, or segments: descending, ascending, morse-smale")
      .value("WHAT")
      .in_detail(
          "What colours the surface; descending segments are one a maximum, ascending ones one a minimum");
  command.switches("--points", "--no-points", picture.points, "Critical points as spheres")
      .shows_default("yes")
      .in_detail("Minima are blue, saddles green, maxima red");
  command.switches("--arcs", "--no-arcs", options->arcs, "Arcs of the Morse-Smale complex as tubes")
      .shows_default("where segments are shown")
      .in_detail("Descending ones are blue, ascending ones red; with segments those that bound them");
  command.switches("--legend", "--no-legend", picture.legend, "The colour bar").shows_default("yes");
  command.text("--caption", options->caption, "Text below the picture; auto is the method and its counts")
      .value("TEXT");
  command
      .choice("--background", picture.transparent,
              std::vector<std::pair<std::string, bool>>{{"white", false}, {"transparent", true}},
              "white or transparent")
      .value("GROUND");
  command.text("--size", options->size, "Width and height in pixels").value("WxH");
  command.number("--samples", picture.samples, "Samples a pixel, 1 to 1024").between(1, 1024);

  command.begin_group("Where it is taken from");
  add_camera_options(command, options->camera);
  command.text("--frame", options->frame, "Draw a frame around what --close-up shows")
      .value("VERTEX[:RADIUS]")
      .in_detail("The radius is 15eps if it is not given");
  command.text("--close-up", options->close_up, "Fill the picture with a vertex and what is around it")
      .value("VERTEX[:RADIUS]")
      .in_detail("The radius is 15eps if it is not given");

  command.begin_group("Colours of the field");
  const std::vector<std::string> colormaps = colormap_names();
  command.text("--colormap", picture.scale.colormap, core::listed(colormaps, " or "))
      .among(colormaps)
      .value("NAME")
      .in_detail("By default blue-orange where the colours have a centre, else sand");
  command
      .text("--range", options->range, "The range of values that the colours span: LOW/HIGH or a percentage")
      .value("RANGE")
      .in_detail("With a percentage, that share of the vertices lies below the range, and as many above");
  command
      .choice(
          "--center", picture.scale.center,
          std::vector<std::pair<std::string, ScaleRequest::Center>>{{"zero", ScaleRequest::Center::zero},
                                                                    {"median", ScaleRequest::Center::median},
                                                                    {"none", ScaleRequest::Center::none}},
          "The value at the middle of the colours: zero, median or none")
      .value("CENTER")
      .in_detail("By default that of a field of both signs is zero, or the median where one sign is rare");
  add_common_options(command, program.common);
  command.examples = {
      {"render scan.off --method salient -o points.png", "the curvature, and the points that salient leaves"},
      {"render scan.off --method salient --show descending --view 30/20 -o parts.png",
       "its segments, from the side"}};
  add_specification_notes(command);
  set_action(program, command, options, draw);
}

}  // namespace morsel::tools
