#pragma once
/// Flat drawing over pictures: text, lines, colour ramps (cairo).

#include <cstdint>
#include <memory>
#include <string_view>

#include "morsel/tools/color/colormap.h"
#include "morsel/tools/render/image.h"

namespace morsel::tools::render {

enum class Align { left, center, right };

/// sRGB, 0xRRGGBB.
using Ink = std::uint32_t;
inline constexpr Ink kBlack = 0x1a1a1a;
inline constexpr Ink kGray = 0x6f6f6f;

/// Coordinates in pixels from the upper left corner; y grows downwards. Text is set in DejaVu Sans, which is
/// built in, so that it looks the same wherever the program runs. The same bytes whenever cairo and FreeType
/// are the same.
class Canvas {
 public:
  Canvas(Size size, bool transparent);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  Size size() const { return size_; }
  /// Draws a picture over the canvas, pixel by pixel, clipped.
  void draw(const Image& image, int x, int y);
  /// One line of UTF-8 with its baseline at y; `size` is that of the em. Throws InvalidArgument on other
  /// bytes.
  void text(double x, double y, double size, std::string_view text, Align align = Align::left,
            Ink ink = kBlack);
  double text_width(double size, std::string_view text);
  void line(double x0, double y0, double x1, double y1, double width, Ink ink = kBlack);
  void frame(double x, double y, double width, double height, double thickness, Ink ink = kBlack);
  void fill(double x, double y, double width, double height, Ink ink);
  /// A triangle filled with a colour.
  void fill_triangle(const double (&x)[3], const double (&y)[3], const Color& color);
  /// The map from its lower end at the bottom to its upper one at the top, row by row.
  void ramp(const Colormap& map, double x, double y, double width, double height);

  Image image() const;

 private:
  struct Surface;
  Size size_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace morsel::tools::render
