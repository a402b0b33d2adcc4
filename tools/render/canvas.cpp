#include "morsel/tools/render/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "morsel/tools/drawing/lettering.h"

namespace morsel::tools::render {
struct Canvas::Surface {
  cairo_surface_t* surface = nullptr;
  cairo_t* cairo = nullptr;
  drawing::Lettering lettering;

  explicit Surface(Size size) {
    surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size.width, size.height);
    cairo = cairo_create(surface);
    if (cairo_status(cairo) != CAIRO_STATUS_SUCCESS) {
      release();
      throw std::bad_alloc();
    }
  }
  ~Surface() { release(); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void release() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }
  void set(Ink ink) {
    const auto channel = [ink](int shift) { return ((ink >> shift) & 0xff) / 255.; };
    cairo_set_source_rgb(cairo, channel(16), channel(8), channel(0));
  }
  void set(const Color& color) {
    const auto [r, g, b] = to_bytes(color);
    cairo_set_source_rgb(cairo, r / 255., g / 255., b / 255.);
  }
};

Canvas::Canvas(Size size, bool transparent) : size_(size) {
  check_size(size);
  surface_ = std::make_unique<Surface>(size);
  if (!transparent) fill(0, 0, size.width, size.height, 0xffffff);
}

Canvas::~Canvas() = default;

void Canvas::draw(const Image& image, int x, int y) {
  cairo_surface_t* source =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.size.width, image.size.height);
  unsigned char* data = cairo_image_surface_get_data(source);
  if (data == nullptr) {
    cairo_surface_destroy(source);
    throw std::bad_alloc();
  }
  const int stride = cairo_image_surface_get_stride(source);
  for (int row = 0; row < image.size.height; ++row)
    for (int column = 0; column < image.size.width; ++column) {
      const std::uint8_t* p = image.pixel(column, row);
      const auto part = [&](int i) { return (std::uint32_t{p[i]} * p[3] + 127) / 255; };
      const std::uint32_t argb = std::uint32_t{p[3]} << 24 | part(0) << 16 | part(1) << 8 | part(2);
      std::memcpy(data + std::ptrdiff_t{row} * stride + 4 * std::ptrdiff_t{column}, &argb, 4);
    }
  cairo_surface_mark_dirty(source);
  cairo_set_source_surface(surface_->cairo, source, x, y);
  cairo_pattern_set_filter(cairo_get_source(surface_->cairo), CAIRO_FILTER_NEAREST);
  cairo_paint(surface_->cairo);
  cairo_surface_destroy(source);
}

void Canvas::text(double x, double y, double size, std::string_view text, Align align, Ink ink) {
  if (align != Align::left) x -= text_width(size, text) * (align == Align::center ? 0.5 : 1);
  drawing::check_text(text);
  surface_->set(ink);
  surface_->lettering.use(surface_->cairo, size);
  cairo_move_to(surface_->cairo, x, y);
  cairo_show_text(surface_->cairo, std::string(text).c_str());
  cairo_new_path(surface_->cairo);
}

double Canvas::text_width(double size, std::string_view text) {
  return surface_->lettering.width(text, size);
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, Ink ink) {
  surface_->set(ink);
  cairo_set_line_width(surface_->cairo, width);
  cairo_move_to(surface_->cairo, x0, y0);
  cairo_line_to(surface_->cairo, x1, y1);
  cairo_stroke(surface_->cairo);
}

void Canvas::frame(double x, double y, double width, double height, double thickness, Ink ink) {
  surface_->set(ink);
  cairo_set_line_width(surface_->cairo, thickness);
  cairo_rectangle(surface_->cairo, x, y, width, height);
  cairo_stroke(surface_->cairo);
}

void Canvas::fill(double x, double y, double width, double height, Ink ink) {
  surface_->set(ink);
  cairo_rectangle(surface_->cairo, x, y, width, height);
  cairo_fill(surface_->cairo);
}

void Canvas::fill_triangle(const double (&x)[3], const double (&y)[3], const Color& color) {
  surface_->set(color);
  cairo_move_to(surface_->cairo, x[0], y[0]);
  cairo_line_to(surface_->cairo, x[1], y[1]);
  cairo_line_to(surface_->cairo, x[2], y[2]);
  cairo_close_path(surface_->cairo);
  cairo_fill(surface_->cairo);
}

void Canvas::ramp(const Colormap& map, double x, double y, double width, double height) {
  const int rows = std::max(1, static_cast<int>(std::lround(height)));
  for (int i = 0; i < rows; ++i) {
    surface_->set(map(1 - (i + 0.5) / rows));
    cairo_rectangle(surface_->cairo, x, y + i * height / rows, width, height / rows);
    cairo_fill(surface_->cairo);
  }
}

Image Canvas::image() const {
  if (cairo_status(surface_->cairo) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();  // of what was drawn something may be missing
  cairo_surface_flush(surface_->surface);
  Image image(size_, true);
  const unsigned char* data = cairo_image_surface_get_data(surface_->surface);
  const int stride = cairo_image_surface_get_stride(surface_->surface);
  for (int row = 0; row < size_.height; ++row)
    for (int column = 0; column < size_.width; ++column) {
      std::uint32_t argb = 0;
      std::memcpy(&argb, data + std::ptrdiff_t{row} * stride + 4 * std::ptrdiff_t{column}, 4);
      const std::uint32_t alpha = argb >> 24;
      if (alpha == 0) continue;
      std::uint8_t* p = image.pixel(column, row);
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t part = (argb >> (16 - 8 * i)) & 0xff;
        p[i] = static_cast<std::uint8_t>(std::min<std::uint32_t>(255, (part * 255 + alpha / 2) / alpha));
      }
      p[3] = static_cast<std::uint8_t>(alpha);
    }
  return image;
}

}  // namespace morsel::tools::render
