#pragma once
/// The layout of a plot.

#include <string>
#include <vector>

#include "morsel/tools/drawing/lettering.h"
#include "morsel/tools/plot/plot.h"
#include "morsel/tools/plot/shapes.h"
#include "morsel/tools/plot/ticks.h"

namespace morsel::tools::plot {

/// Sizes of letters, in points.
inline constexpr double kTitleSize = 9, kPanelSize = 8, kCaptionSize = 7, kLabelSize = 8, kTickSize = 7,
                        kLegendSize = 7.5, kNoteSize = 6.5;
inline constexpr double kMargin = 6;  ///< round everything
inline constexpr double kTickLength = 3;

/// One line of text at its place.
struct Line {
  Spot spot;
  std::string text;
  Letters letters;
};

/// A series, ready to be drawn.
struct DrawnSeries {
  const Series* series;
  std::vector<std::vector<Spot>> lines;
  std::vector<Spot> marks;
  double radius = 0;
};

struct DrawnPanel {
  Box frame;
  double finite_top = 0;  ///< the place of the y axis's upper end: below the frame's if +∞ has a line
  std::vector<Spot> diagonal;
  std::vector<DrawnSeries> series;
};

struct LegendEntry {
  Spot spot;  ///< the middle of the left end of its sample
  const Series* series;
};

struct Layout {
  double width = 0;
  double height = 0;
  std::vector<DrawnPanel> panels;
  std::vector<double> x_major, x_minor, y_major, y_minor;  ///< places, from the frame's left end and its top
  bool infinity = false;
  double infinity_depth = 0;  ///< place of the line of +∞ below the frame's top
  std::vector<LegendEntry> legend;
  double sample = 0;  ///< width of what is shown in the legend
  std::vector<Line> lines;
};

/// Throws InvalidArgument as write_svg() says. Refers to the plot.
Layout lay_out(const Plot& plot, drawing::Lettering& lettering);

}  // namespace morsel::tools::plot
