// morsel render: a picture of a surface, its field and its critical points.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "morsel/core/error.h"
#include "morsel/core/file_writer.h"
#include "morsel/core/parameters.h"
#include "morsel/tools/commands/commands.h"
#include "morsel/tools/comparison/made_field.h"
#include "morsel/tools/render/colormap.h"
#include "morsel/tools/render/picture.h"

namespace morsel::tools {
namespace {

struct Options {
  std::string mesh;
  FieldRequest field;
  std::string output;
  render::PictureRequest picture;
  std::optional<bool> arcs;
  std::string size = "1200x900";
  std::string view = "best";
  render::UpAxis up = render::UpAxis::y;
  std::string background = "white";
  std::string range = "2%";
  std::string inset;
  std::string caption;
};

render::Size parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos)
    throw core::InvalidArgument("a size is WIDTHxHEIGHT in pixels, such as 1200x900, not '" + text + "'");
  const auto side = [&](const std::string& part) {
    const std::int64_t n = core::parse_integer(part, "a picture's side");
    return static_cast<int>(std::clamp<std::int64_t>(n, -1, 1 << 30));  // check_size() says what is allowed
  };
  const render::Size size{side(text.substr(0, x)), side(text.substr(x + 1))};
  render::check_size(size);
  return size;
}

struct InsetText {
  std::int64_t vertex;
  std::optional<core::Length> radius;
};

InsetText parse_inset(const std::string& text) {
  const std::size_t colon = text.find(':');
  InsetText inset{core::parse_integer(text.substr(0, colon), "the vertex of an inset"), {}};
  if (colon != std::string::npos) inset.radius = core::parse_length(text.substr(colon + 1), "the radius of an inset");
  return inset;
}

render::Inset find_inset(const InsetText& text, const core::LoadedMesh& loaded) {
  const core::VertexNumbering& numbering = loaded.source.numbering;
  const std::size_t count = numbering.from_input.empty() ? loaded.mesh.vertex_count() : numbering.from_input.size();
  const core::Index vertex = text.vertex >= 0 && static_cast<std::size_t>(text.vertex) < count
                                 ? numbering.mesh_vertex(static_cast<core::Index>(text.vertex))
                                 : core::kNone;
  if (vertex == core::kNone)
    throw core::InvalidArgument("there is no vertex " + std::to_string(text.vertex) + " to magnify: the input has " +
                                std::to_string(count) + ", from 0 on, less those that repair dropped");
  render::Inset inset{vertex};
  if (text.radius) inset.radius = *text.radius;
  return inset;
}

int draw(const Options& options, const CommonOptions& common, Console& console) {
  render::PictureRequest request = options.picture;
  request.size = parse_size(options.size);
  request.transparent = options.background == "transparent";
  request.arcs = options.arcs.value_or(request.show != render::Show::field && request.show != render::Show::plain);
  render::parse_range(options.range, request.scale);
  if (!request.scale.colormap.empty()) const render::Colormap known(request.scale.colormap);
  if (options.view != "best") render::named_view(options.view, options.up);
  const std::optional<InsetText> inset =
      options.inset.empty() ? std::nullopt : std::optional(parse_inset(options.inset));
  const FieldRecipe recipe = prepare(options.field);
  core::FileWriter file(options.output);

  const core::Progress progress = console.progress();
  const core::LoadedMesh loaded = core::read_mesh(options.mesh, {.repair = common.repair}, progress);
  if (inset) request.inset = find_inset(*inset, loaded);
  const MadeField made = make_field(recipe, loaded, progress);
  tell_target(made, console);
  Timings timings;
  const Measurement measurement = measure(made.field(), timings, progress);

  const render::Studio studio(loaded.mesh);
  const std::string counts = render::counts_line(measurement.critical_points);
  render::Subject subject{made.field(), &measurement,
                          render::quantity_of(made.input.name, recipe.chain.steps.back().name), options.caption};
  if (subject.caption == "auto") subject.caption = recipe.chain.name + "\n" + counts;
  const render::Image image = studio.take(studio.view(options.view, options.up, progress), subject, request, progress);
  file.write(render::encode_png(image));
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
      "render", "Take a picture (PNG) of a surface coloured by a field or its segments, with critical points and arcs");
  add_field_options(command, options->mesh, options->field);
  command
      .add_option("--show", picture.show,
                  "What colours the surface: field, plain, or segments: descending (one a maximum),\n"
                  "ascending (one a minimum), morse-smale")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Show>{{"field", Show::field},
                                      {"plain", Show::plain},
                                      {"descending", Show::descending},
                                      {"ascending", Show::ascending},
                                      {"morse-smale", Show::morse_smale}}))
      ->type_name("WHAT")
      ->default_str("field");
  command.add_flag("--points,!--no-points", picture.points,
                   "Critical points as spheres: minima blue, saddles green, maxima red (default: yes)");
  command.add_flag("--arcs,!--no-arcs", options->arcs,
                   "The arcs of the Morse-Smale complex as tubes: descending blue, ascending red\n"
                   "(default: where segments are shown)");
  command.add_option("--size", options->size, "Width and height in pixels")->type_name("WxH")->capture_default_str();
  command
      .add_option("--view", options->view,
                  "best (shows most of the mesh saliency), front, back, left, right, top, bottom, or\n"
                  "azimuth/elevation in degrees, 0/0 being the front and 90/0 the right")
      ->type_name("VIEW")
      ->capture_default_str();
  command
      .add_option("--up", options->up,
                  "The axis that points up; the front is seen from +z (y up), -y (z up) or +y (x up)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, render::UpAxis>{
          {"x", render::UpAxis::x}, {"y", render::UpAxis::y}, {"z", render::UpAxis::z}}))
      ->type_name("AXIS")
      ->default_str("y");
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
                  "One of" + colormaps() + " (default: blue-orange\nwith a centre, else viridis)")
      ->type_name("NAME");
  command
      .add_option("--range", options->range,
                  "Values at the ends of the colours: LOW/HIGH, or the percentage of the vertices to cut\n"
                  "off at either end")
      ->type_name("RANGE")
      ->capture_default_str();
  command
      .add_option("--center", picture.scale.center,
                  "The value in the middle of the colours: zero, median, none (default: zero where the field\n"
                  "has both signs)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ScaleRequest::Center>{{"zero", ScaleRequest::Center::zero},
                                                      {"median", ScaleRequest::Center::median},
                                                      {"none", ScaleRequest::Center::none}}))
      ->type_name("CENTER");
  command.add_flag("--legend,!--no-legend", picture.legend, "The colour bar (default: yes)");
  command
      .add_option("--inset", options->inset,
                  "Magnify what lies within a radius (default 25eps) of a vertex, in a corner")
      ->type_name("VERTEX[:RADIUS]");
  command.add_option("--caption", options->caption, "Text below the picture; auto is the method and its counts")
      ->type_name("TEXT");
  command.add_option("-o,--output", options->output, "The picture")->type_name("OUT.png")->required();
  add_common_options(command, invocation.common);
  command.footer(specification_help());
  command.callback([options, &invocation] {
    invocation.action = [options, &invocation](Console& console) {
      return draw(*options, invocation.common, console);
    };
  });
}

}  // namespace morsel::tools
