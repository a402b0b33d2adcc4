#include "morsel/tools/render/request_text.h"

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools::render {

Size parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos)
    throw core::InvalidArgument("a size is WIDTHxHEIGHT in pixels, such as 1200x900, not '" + text + "'");
  const auto side = [](const std::string& part) {
    const std::int64_t n = core::parse_integer(part, "a picture's side");
    return static_cast<int>(std::clamp<std::int64_t>(n, -1, 1 << 30));  // check_size() says what is allowed
  };
  const Size size{side(text.substr(0, x)), side(text.substr(x + 1))};
  check_size(size);
  return size;
}

InsetText parse_inset(const std::string& text) {
  const std::size_t colon = text.find(':');
  InsetText inset;
  inset.vertex = core::parse_integer(text.substr(0, colon), "the vertex of an inset");
  if (colon != std::string::npos)
    inset.radius = core::parse_length(text.substr(colon + 1), "the radius of an inset");
  return inset;
}

Inset find_inset(const InsetText& text, const core::LoadedMesh& loaded) {
  const core::VertexNumbering& numbering = loaded.source.numbering;
  const std::size_t count =
      numbering.from_input.empty() ? loaded.mesh.vertex_count() : numbering.from_input.size();
  const core::Index vertex = text.vertex >= 0 && static_cast<std::size_t>(text.vertex) < count
                                 ? numbering.mesh_vertex(static_cast<core::Index>(text.vertex))
                                 : core::kNone;
  if (vertex == core::kNone)
    throw core::InvalidArgument("there is no vertex " + std::to_string(text.vertex) +
                                " to magnify: the input's vertices are 0 to " + std::to_string(count - 1) +
                                ", less those that repair dropped");
  return {vertex, text.radius};
}

void CameraText::check() const {
  if (view != "best") named_view(view, up);
  if (!inset.empty()) parse_inset(inset);
}

void FigureText::check() const {
  parse_size(size);
  camera.check();
}

std::string to_string(ScaleRequest::Center center) {
  switch (center) {
    case ScaleRequest::Center::automatic:
      return "automatic";
    case ScaleRequest::Center::zero:
      return "zero";
    case ScaleRequest::Center::median:
      return "median";
    case ScaleRequest::Center::none:
      break;
  }
  return "none";
}

std::string to_string(Show show) {
  if (const std::optional<mscomplex::SegmentKind> kind = segments_of(show)) return to_string(*kind);
  return show == Show::field ? "field" : "plain";
}

Json picture_section(const PictureRequest& request, const CameraText& camera, const std::string& caption,
                     const core::VertexNumbering& numbering) {
  const auto region = [&](const std::optional<Inset>& inset) -> Json {
    if (!inset) return nullptr;
    return {{"vertex", numbering.input_vertex(inset->vertex)}, {"radius", core::to_string(inset->radius)}};
  };
  const ScaleRequest& scale = request.scale;
  return {{"size", {request.size.width, request.size.height}},
          {"samples", request.samples},
          {"background", request.transparent ? "transparent" : "white"},
          {"view", camera.view},
          {"up", to_string(camera.up)},
          {"show", to_string(request.show)},
          {"points", request.points},
          {"arcs", request.arcs},
          {"legend", request.legend},
          {"colormap", scale.colormap.empty() ? Json() : Json(scale.colormap)},
          {"center", to_string(scale.center)},
          {"clip", scale.limits ? Json() : Json(scale.clip)},
          {"limits", scale.limits ? Json({scale.limits->first, scale.limits->second}) : Json()},
          {"inset", region(request.inset)},
          {"frame", region(request.frame)},
          {"close_up", region(request.close_up)},
          {"caption", caption}};
}

}  // namespace morsel::tools::render
