#pragma once
/// Plots as SVG.

#include <string>

#include "morsel/tools/drawing/lettering.h"
#include "morsel/tools/plot/canvas.h"

namespace morsel::tools::plot {

/// Makes the text of a document without ids, styles and scripts, so that several can be put into one page.
/// Coordinates have two decimals.
class SvgCanvas : public Canvas {
 public:
  /// Refers to the lettering, by which texts are given their widths.
  SvgCanvas(double width, double height, std::string_view title, std::string_view metadata,
            drawing::Lettering& lettering);
  void line(const std::vector<Spot>& spots, const Pen& pen) override;
  void rectangle(const Box& box, const Pen& pen) override;
  void marks(const std::vector<Spot>& spots, Mark mark, double radius, Color color, double opacity) override;
  void text(Spot spot, std::string_view text, const Letters& letters) override;
  void open(std::string_view name) override;
  void close() override;

  /// The whole document; nothing may be drawn afterwards.
  std::string finish();

 private:
  std::string document_;
  drawing::Lettering& lettering_;
};

}  // namespace morsel::tools::plot
