#include "morsel/tools/render/request_words.h"

#include <optional>

#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/command_line.h"

namespace morsel::tools::render {
namespace {

void add_target(std::vector<std::string>& words, const std::optional<std::size_t>& target) {
  if (target) add_option(words, "--target", std::to_string(*target));
}

void add_points(std::vector<std::string>& words, const PointsRequest& points) {
  add_option(words, "--points", std::to_string(points.count));
  add_option(words, "--kind", std::string(to_string(points.kind)));
  add_option(words, "--rank", std::string(to_string(points.rank)));
  add_option(words, "--spacing", core::to_string(points.spacing));
  if (points.fill) add_option(words, "--fill", *points.fill);
  if (points.scale) add_option(words, "--salience-scale", core::to_string(*points.scale));
  add_flag(words, "--percentiles", points.percentiles);
}

void add_colors(std::vector<std::string>& words, const ScaleRequest& scale) {
  if (scale.limits)
    add_option(words, "--range",
               core::shortest(scale.limits->first) + "/" + core::shortest(scale.limits->second));
  else if (scale.clip != ScaleRequest{}.clip)
    add_option(words, "--range", core::shortest(scale.clip) + "%");
  if (!scale.colormap.empty()) add_option(words, "--colormap", scale.colormap);
  if (scale.center != ScaleRequest::Center::automatic) add_option(words, "--center", to_string(scale.center));
}

}  // namespace

std::vector<std::string> words_of(const ComparisonRequest& request, bool repair) {
  std::vector<std::string> words;
  add_option(words, "--field", request.field);
  for (const std::string& method : request.methods) add_option(words, "--method", method);
  add_target(words, request.target);
  add_flag(words, "--snap", request.snap);
  if (request.points) add_points(words, *request.points);
  add_flag(words, "--repair", repair);
  return words;
}

std::vector<std::string> words_of(const FieldRequest& request, bool repair) {
  std::vector<std::string> words;
  add_option(words, "--field", request.field);
  add_option(words, "--method", request.method);
  add_target(words, request.target);
  add_flag(words, "--repair", repair);
  return words;
}

std::vector<std::string> words_of_thumbnails(const CameraText& camera) {
  std::vector<std::string> words;
  add_option(words, "--view", camera.view);
  add_option(words, "--up", to_string(camera.up));
  return words;
}

std::vector<std::string> words_of(const FigureText& figure) {
  std::vector<std::string> words = words_of_thumbnails(figure.camera);
  add_option(words, "--size", figure.size);
  if (!figure.camera.inset.empty()) add_option(words, "--inset", figure.camera.inset);
  return words;
}

std::vector<std::string> words_of(const PictureRequest& request, const CameraText& camera,
                                  const std::string& caption, const core::VertexNumbering& numbering) {
  std::vector<std::string> words;
  const auto add_region = [&](const std::string& name, const std::optional<Inset>& region) {
    if (region)
      add_option(
          words, name,
          std::to_string(numbering.input_vertex(region->vertex)) + ":" + core::to_string(region->radius));
  };
  const bool has_segments = segments_of(request.show).has_value();
  if (request.show != Show::field) add_option(words, "--show", to_string(request.show));
  add_flag(words, "--no-points", !request.points);
  add_flag(words, "--no-legend", !request.legend);
  if (request.arcs != has_segments) add_flag(words, request.arcs ? "--arcs" : "--no-arcs", true);
  add_colors(words, request.scale);
  add_region("--inset", request.inset);
  add_region("--frame", request.frame);
  add_region("--close-up", request.close_up);
  if (request.transparent) add_option(words, "--background", "transparent");
  if (!caption.empty()) add_option(words, "--caption", caption);
  add_option(words, "--view", camera.view);
  if (camera.up != CameraText{}.up) add_option(words, "--up", to_string(camera.up));
  add_option(words, "--size", std::to_string(request.size.width) + "x" + std::to_string(request.size.height));
  add_option(words, "--samples", std::to_string(request.samples));
  return words;
}

}  // namespace morsel::tools::render
