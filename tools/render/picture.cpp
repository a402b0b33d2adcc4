#include "morsel/tools/render/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/color/mark_sizes.h"
#include "morsel/tools/color/regions.h"
#include "morsel/tools/render/best_view.h"
#include "morsel/tools/render/canvas.h"
#include "morsel/tools/render/caption.h"
#include "morsel/tools/render/glyphs.h"
#include "morsel/tools/render/inset.h"
#include "morsel/tools/render/tracer.h"

namespace morsel::tools::render {
namespace {

const Color kPlain = from_hex(0xd9d4ca);
constexpr double kCloseBall = 0.045;  // the largest sphere of a close-up, in radii of what it shows

void color_surface(Scene& scene, const Subject& subject, Show show, const ValueScale& scale) {
  if (const std::optional<mscomplex::SegmentKind> kind = segments_of(show)) {
    scene.surface = color_segments(scene.body.mesh, subject.measurement->segmentation, *kind);
  } else if (show == Show::plain) {
    scene.surface = kPlain;
  } else {
    ValueColors colors{{}, scale.map};
    for (const double value : subject.field.values())
      colors.values.push_back(static_cast<float>(std::clamp(scale.position(value), -4., 5.)));
    scene.surface = std::move(colors);
  }
}

}  // namespace

std::optional<mscomplex::SegmentKind> segments_of(Show show) {
  switch (show) {
    case Show::descending:
      return mscomplex::SegmentKind::descending;
    case Show::ascending:
      return mscomplex::SegmentKind::ascending;
    case Show::morse_smale:
      return mscomplex::SegmentKind::morse_smale;
    case Show::field:
    case Show::plain:
      break;
  }
  return std::nullopt;
}

Subject subject_of(const MethodOutcome& outcome, const std::string& field_name, const std::string& unit) {
  return {outcome.field,          &outcome.measurement,   quantity_of(field_name, unit, outcome.quantity), "",
          outcome.shown_places(), &outcome.shown_points()};
}

Studio::Studio(const core::TriangleMesh& mesh)
    : body_(make_body(mesh)), rays_(body_.mesh), unit_(mesh.bounding_box().diagonal()), mesh_(mesh) {}

View Studio::view(const std::string& name, UpAxis up, const core::Progress& progress) const {
  if (name != "best") return named_view(name, up);
  if (!(unit_ > 0)) return view_at(0, 0, up);  // all vertices coincide: every view is the same
  return best_view(body_, rays_, view_weights(body_, progress), up, progress);
}

std::vector<bool> Studio::shown(const View& view, double least_cosine) const {
  std::vector<char> seen(body_.mesh.vertex_count());  // not bool: threads write side by side
  const core::Point eye = fit_camera(body_.mesh.positions(), view, 1).eye;
  core::parallel_for_each(seen.size(), [&](std::size_t v) {
    const core::Point& normal = body_.normals[v];
    const core::Point start = body_.mesh.position(static_cast<core::Index>(v)) + 1e-4 * normal;
    const core::Point way = (eye - start).normalized();
    seen[v] =
        normal.dot(way) >= least_cosine && !rays_.any(start.cast<float>(), way.cast<float>(), 1e-4f, kFar);
  });
  return {seen.begin(), seen.end()};
}

Image Studio::take(const View& view, const Subject& subject, const PictureRequest& request,
                   const core::Progress& progress) const {
  check_size(request.size);
  if (!subject.field.mesh().is_same(mesh_))
    throw core::InvalidArgument("a picture's field is on another mesh");
  const bool measured = request.points || request.arcs || segments_of(request.show);
  if (measured && subject.measurement == nullptr)
    throw core::InvalidArgument("critical points, arcs and segments are shown of a measured field only");

  if (request.close_up && (request.inset || request.frame))
    throw core::InvalidArgument("a close-up has no further region magnified or framed in it");
  const auto radius_of = [&](const Inset& region) { return unit_ > 0 ? region.radius.on(mesh_) / unit_ : 0; };

  // The layout: caption below, colour bar on the right, the surface in what is left.
  const Size size = request.size;
  const double em = letter_size(size);
  const int caption = caption_height(subject.caption, em);
  const ValueScale scale = choose_scale(subject.field.values(), request.scale);
  const bool legend =
      request.legend && request.show == Show::field && size.width >= 240 && size.height >= 160;
  Canvas canvas(size, request.transparent);
  const int strip = legend ? legend_width(canvas, scale, subject.quantity, em) : 0;
  const Size frame{size.width - strip, size.height - caption};
  if (frame.width < 1 || frame.height < 1)
    throw core::InvalidArgument("a picture of " + std::to_string(size.width) + "x" +
                                std::to_string(size.height) + " pixels has no room for its caption");

  Scene scene{body_};
  color_surface(scene, subject, request.show, scale);
  if (measured) {
    const morse::CriticalPoints& points =
        subject.points != nullptr ? *subject.points : subject.measurement->critical_points;
    MarkSizes sizes = mark_sizes(body_.area, points.total());
    if (request.close_up) {
      sizes.ball = std::min(sizes.ball, kCloseBall * radius_of(*request.close_up));
      sizes.tube = std::min(sizes.tube, 0.4 * sizes.ball);
    }
    if (request.points) add_points(scene, points, sizes.ball, subject.places);
    if (request.arcs) {
      const bool borders = segments_of(request.show).has_value();
      const double freedom = borders ? 0.7 * sizes.tube : std::numeric_limits<double>::infinity();
      std::optional<mscomplex::ArcKind> only;  // those that bound the segments shown
      if (request.show == Show::descending) only = mscomplex::ArcKind::descending;
      if (request.show == Show::ascending) only = mscomplex::ArcKind::ascending;
      add_arcs(scene, rays_, subject.measurement->complex, sizes.tube, freedom, only);
    }
  }
  const Tracer tracer(scene);
  const double aspect = static_cast<double>(frame.width) / frame.height;
  const Camera camera = fit_camera(body_.mesh.positions(), view, aspect);
  const auto window_of = [&](const Inset& region) {
    return window_around(camera, body_.mesh.position(region.vertex), radius_of(region));
  };
  TraceOptions options{frame, request.samples, request.transparent, true, {}};
  if (request.close_up) options.window = window_of(*request.close_up);
  const Image surface = tracer.trace(camera, options, progress);
  canvas.draw(surface, 0, 0);
  if (request.frame) draw_window(canvas, frame, window_of(*request.frame), em);
  if (request.inset)
    draw_inset(canvas, surface, tracer, camera, options, body_.mesh.position(request.inset->vertex),
               radius_of(*request.inset), em, progress);
  if (legend) draw_legend(canvas, scale, subject.quantity, em, frame.width, frame.height);
  draw_caption(canvas, subject.caption, em, 0, frame.height, size.width);
  return canvas.image();
}

}  // namespace morsel::tools::render
