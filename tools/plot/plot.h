#pragma once
/// Plots for papers, as SVG and as PNG, without a display: a description and two functions that draw it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"

namespace morsel::tools::plot {

/// sRGB, 0xRRGGBB.
using Color = std::uint32_t;

/// Colours that the colour-blind can distinguish, on white, the strongest first (Okabe and Ito 2008, without
/// their yellow).
inline constexpr Color kPalette[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x000000};

enum class Scale {
  linear,
  log,
  symmetric  ///< asinh: linear about 0, logarithmic far from it on both sides
};

/// The positions of values: a finite one by the scale; +∞ on a line of its own beyond the y axis's upper end.
struct Axis {
  std::string label = {};
  std::string unit = {};  ///< shown in brackets after the label
  Scale scale = Scale::linear;
  double linear = 1;  ///< how far from 0 a symmetric scale is about linear; > 0
  /// The range shown; by default that of the values with a small margin.
  std::optional<double> lower = {};
  std::optional<double> upper = {};
  /// Of a linear axis with categories instead of numbers: the i-th is at i, shortened where it has no room.
  std::vector<std::string> names = {};
};

enum class Draw {
  marks,  ///< a mark at each point, in no order
  line,   ///< from point to point, which are marked if they are few
  steps   ///< y of a point holds up to the x of the next, where it jumps
};

enum class Mark { disc, square, triangle, diamond };
enum class Dash { solid, dashed, dotted, dash_dot };

/// Points and how they are drawn. Series of equal names look alike and have one entry in the legend.
struct Series {
  std::string name = {};  ///< in the legend; no entry without one
  Draw draw = Draw::marks;
  Color color = kPalette[0];
  Mark mark = Mark::disc;
  Dash dash = Dash::solid;
  std::vector<double> x = {};
  std::vector<double> y = {};  ///< as many as x
};

/// The look of the i-th line of many: all colours of the palette solid, then dashed, and so on; 28 in all.
void set_line_style(Series& series, std::size_t i);

/// A frame with points in it; the later series are drawn over the earlier.
struct Panel {
  std::string title = {};
  std::string caption = {};  ///< a smaller line below the title
  std::vector<Series> series = {};
};

/// One panel, or several that have their axes in common, row by row; a legend and notes below.
struct Plot {
  std::string title = {};
  Axis x = {};
  Axis y = {};
  /// Both axes have the same scale and show the same range, and the diagonal is drawn, as in persistence
  /// diagrams.
  bool diagonal = false;
  std::vector<Panel> panels = {};
  std::size_t columns = 1;              ///< of panels
  std::vector<std::string> notes = {};  ///< small print, a line each, broken where it is too long
  /// Kept in the file for programs, in ASCII without < and &: an SVG's <metadata>, a PNG's comment; none if
  /// it is empty.
  std::string metadata = {};
  double width = kColumnWidth;  ///< in points of 1/72 inch; the height follows from what is in the plot

  static constexpr double kColumnWidth = 252;  ///< of a column of a two-column paper: 3.5 inches
  static constexpr double kPageWidth = 516;    ///< of both columns
};

/// Writes the plot, whole or not at all. The same bytes for the same plot whatever the number of threads, the
/// time and the machine's fonts. Text is text in DejaVu Sans; where that is missing, another font is fitted
/// into the same place.
///
/// Of crowded marks only some are drawn: where a series has more than one for 5 square points of its panel
/// (8,000 in a column's), one in each cell of a grid, and a note below the plot has their number. Lines lose
/// the points that do not move them by a fifth of a printer's point. So files stay below some hundred
/// kilobytes however many points there are. O(number of points).
///
/// Throws InvalidArgument for a plot that cannot be drawn: no panel, x and y of different sizes, NaN,
/// infinities other than y = +∞ of marks, values beyond ±1e300 or of 0 or less on a logarithmic axis, limits
/// that are not an interval, a width outside 100 to 2000, text that is not UTF-8 or has control characters;
/// WriteFailed where writing fails. May be called from several threads at once.
void write_svg(const core::FileTarget& target, const Plot& plot);

/// The same drawing in pixels, `width` of them from left to right (100 to 10,000, else InvalidArgument):
/// 8-bit RGB on white. The same bytes as long as cairo, FreeType and zlib stay the same.
void write_png(const core::FileTarget& target, const Plot& plot, int width);

}  // namespace morsel::tools::plot
