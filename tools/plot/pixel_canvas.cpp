#include "morsel/tools/plot/pixel_canvas.h"

#include <cairo.h>

#include <cmath>
#include <exception>
#include <new>
#include <numbers>

#include "morsel/core/error.h"

namespace morsel::tools::plot {

PixelCanvas::PixelCanvas(double width, double height, double scale, drawing::Lettering& lettering)
    : lettering_(lettering) {
  constexpr double kMost = 32767;  // what cairo can
  const double columns = std::round(width * scale), rows = std::ceil(height * scale - 1e-6);
  if (columns > kMost || rows > kMost)
    throw core::InvalidArgument("a plot of " + std::to_string(static_cast<long long>(columns)) + " x " +
                                std::to_string(static_cast<long long>(rows)) +
                                " pixels is too large: at most 32767 can be in a row or column");
  surface_ =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(columns), static_cast<int>(rows));
  context_ = cairo_create(surface_);
  if (cairo_status(context_) != CAIRO_STATUS_SUCCESS) {
    cairo_destroy(context_);
    cairo_surface_destroy(surface_);
    throw std::bad_alloc();
  }
  set(0xffffff);
  cairo_paint(context_);
  cairo_scale(context_, scale, scale);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
}

PixelCanvas::~PixelCanvas() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

void PixelCanvas::set(Color color, double opacity) {
  const auto channel = [color](int shift) { return ((color >> shift) & 0xff) / 255.; };
  cairo_set_source_rgba(context_, channel(16), channel(8), channel(0), opacity);
}

void PixelCanvas::stroke(const Pen& pen) {
  set(pen.color);
  cairo_set_line_width(context_, pen.width);
  std::vector<double> lengths = dash_lengths(pen.dash);
  for (double& length : lengths) length *= pen.width;
  cairo_set_dash(context_, lengths.data(), static_cast<int>(lengths.size()), 0);
  cairo_stroke(context_);
}

void PixelCanvas::line(const std::vector<Spot>& spots, const Pen& pen) {
  for (const Spot& spot : spots) cairo_line_to(context_, spot.x, spot.y);  // the first one moves there
  stroke(pen);
}

void PixelCanvas::rectangle(const Box& box, const Pen& pen) {
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  stroke(pen);
}

void PixelCanvas::marks(const std::vector<Spot>& spots, Mark mark, double radius, Color color,
                        double opacity) {
  const std::vector<Spot> corners = mark_corners(mark, radius);
  for (const Spot& spot : spots) {
    if (mark == Mark::disc) {
      cairo_new_sub_path(context_);
      cairo_arc(context_, spot.x, spot.y, radius, 0, 2 * std::numbers::pi);
    } else {
      cairo_new_sub_path(context_);
      for (const Spot& corner : corners) cairo_line_to(context_, spot.x + corner.x, spot.y + corner.y);
    }
    cairo_close_path(context_);
  }
  set(color, opacity);
  cairo_fill(context_);
}

void PixelCanvas::text(Spot spot, std::string_view text, const Letters& letters) {
  drawing::check_text(text);
  const double width = lettering_.width(text, letters.size);
  const double back = letters.align == Align::left ? 0 : letters.align == Align::center ? width / 2 : width;
  cairo_save(context_);
  lettering_.use(context_, letters.size);
  cairo_translate(context_, spot.x, spot.y);
  if (letters.upwards) cairo_rotate(context_, -std::numbers::pi / 2);
  cairo_move_to(context_, -back, 0);
  set(letters.color);
  cairo_show_text(context_, std::string(text).c_str());
  cairo_restore(context_);
  cairo_new_path(context_);
}

std::string PixelCanvas::png() {
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned int size) {
    try {
      static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
      return CAIRO_STATUS_SUCCESS;
    } catch (const std::exception&) {  // must not pass through C
      return CAIRO_STATUS_NO_MEMORY;
    }
  };
  if (cairo_status(context_) != CAIRO_STATUS_SUCCESS ||
      cairo_surface_write_to_png_stream(surface_, append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();  // the only possible failure of a valid drawing
  return bytes;
}

}  // namespace morsel::tools::plot
