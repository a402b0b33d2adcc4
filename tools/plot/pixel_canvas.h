#pragma once
/// Plots as pixels.

#include <string>

#include "morsel/tools/drawing/lettering.h"
#include "morsel/tools/plot/canvas.h"

namespace morsel::tools::plot {

/// Draws on a white image, `scale` pixels a printer's point.
class PixelCanvas : public Canvas {
 public:
  /// Throws InvalidArgument if there would be more than 32,767 pixels in a row or column. Refers to the
  /// lettering.
  PixelCanvas(double width, double height, double scale, drawing::Lettering& lettering);
  ~PixelCanvas() override;
  PixelCanvas(const PixelCanvas&) = delete;
  PixelCanvas& operator=(const PixelCanvas&) = delete;
  void line(const std::vector<Spot>& spots, const Pen& pen) override;
  void rectangle(const Box& box, const Pen& pen) override;
  void marks(const std::vector<Spot>& spots, Mark mark, double radius, Color color, double opacity) override;
  void text(Spot spot, std::string_view text, const Letters& letters) override;
  void open(std::string_view) override {}
  void close() override {}

  /// The bytes of a PNG file.
  std::string png();

 private:
  void set(Color color, double opacity = 1);
  void stroke(const Pen& pen);

  drawing::Lettering& lettering_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* context_ = nullptr;
};

}  // namespace morsel::tools::plot
