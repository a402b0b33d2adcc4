#pragma once
/// The interface by which plots are drawn: a few shapes, on different media.

#include <string_view>
#include <vector>

#include "morsel/tools/plot/plot.h"

namespace morsel::tools::plot {

/// Printer's points of 1/72 inch from the upper left corner; y grows downwards.
struct Spot {
  double x = 0;
  double y = 0;
};

struct Box {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Pen {
  Color color = 0;
  double width = 1;
  Dash dash = Dash::solid;
};

enum class Align { left, center, right };

struct Letters {
  double size = 8;  ///< of the em
  Color color = 0;
  Align align = Align::left;
  bool upwards = false;  ///< turned, to be read from the right
};

/// Lengths of strokes and gaps of a dash, in widths of the pen.
std::vector<double> dash_lengths(Dash dash);

/// The corners of a mark about the origin, in one orientation; not of a disc.
std::vector<Spot> mark_corners(Mark mark, double radius);

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void line(const std::vector<Spot>& spots, const Pen& pen) = 0;
  virtual void rectangle(const Box& box, const Pen& pen) = 0;
  /// All of them have this opacity together, also where they overlap.
  virtual void marks(const std::vector<Spot>& spots, Mark mark, double radius, Color color,
                     double opacity) = 0;
  /// `spot` is where the baseline begins, or its middle or end. `text` is UTF-8.
  virtual void text(Spot spot, std::string_view text, const Letters& letters) = 0;
  /// Begins a named group, which ends at close().
  virtual void open(std::string_view name) = 0;
  virtual void close() = 0;
};

}  // namespace morsel::tools::plot
