// In place of Embree, cairo and libpng, in a program without pictures: neither a canvas nor a scene can be
// made, so nothing of them is ever called.

#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/render/canvas.h"
#include "morsel/tools/render/rays.h"

namespace morsel::tools::render {

struct Canvas::Surface {};

Canvas::Canvas(Size size, bool) : size_(size) { drawing::require_pictures("a picture"); }
Canvas::~Canvas() = default;
void Canvas::draw(const Image&, int, int) {}
void Canvas::text(double, double, double, std::string_view, Align, Ink) {}
double Canvas::text_width(double, std::string_view) { return 0; }
void Canvas::line(double, double, double, double, double, Ink) {}
void Canvas::frame(double, double, double, double, double, Ink) {}
void Canvas::fill(double, double, double, double, Ink) {}
void Canvas::fill_triangle(const double (&)[3], const double (&)[3], const Color&) {}
void Canvas::ramp(const Colormap&, double, double, double, double) {}
Image Canvas::image() const { return {size_, false}; }

struct Rays::Scene {};

Rays::Rays(const core::TriangleMesh&, std::span<const Ball>, std::span<const Capsule>) {
  drawing::require_pictures("a picture");
}
Rays::~Rays() = default;
Rays::Rays(Rays&&) noexcept = default;
Rays& Rays::operator=(Rays&&) noexcept = default;
bool Rays::first(const Vec3&, const Vec3&, float, float, Hit&) const { return false; }
bool Rays::any(const Vec3&, const Vec3&, float, float) const { return false; }

std::string encode_png(const Image&) {
  drawing::require_pictures("a PNG file");
  return {};
}

}  // namespace morsel::tools::render
