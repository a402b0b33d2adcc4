// In place of cairo, in a program without pictures: no canvas can be made, so nothing of it is ever called.

#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/plot/pixel_canvas.h"

namespace morsel::tools::plot {

PixelCanvas::PixelCanvas(double, double, double, drawing::Lettering& lettering) : lettering_(lettering) {
  drawing::require_pictures("a plot");
}
PixelCanvas::~PixelCanvas() = default;
void PixelCanvas::line(const std::vector<Spot>&, const Pen&) {}
void PixelCanvas::rectangle(const Box&, const Pen&) {}
void PixelCanvas::marks(const std::vector<Spot>&, Mark, double, Color, double) {}
void PixelCanvas::text(Spot, std::string_view, const Letters&) {}
std::string PixelCanvas::png() { return {}; }

}  // namespace morsel::tools::plot
