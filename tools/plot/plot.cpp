#include "morsel/tools/plot/plot.h"

#include <algorithm>
#include <iterator>
#include <memory>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/tools/formats/png_comment.h"
#include "morsel/tools/plot/layout.h"
#include "morsel/tools/plot/pixel_canvas.h"
#include "morsel/tools/plot/svg_canvas.h"

namespace morsel::tools::plot {
namespace {

const Pen kGrid{0xe4e4e4, 0.5, Dash::solid};
const Pen kFrame{0x333333, 0.7, Dash::solid};
const Pen kMinorTick{0x333333, 0.4, Dash::solid};
const Pen kDiagonal{0x888888, 0.6, Dash::solid};
const Pen kInfinityLine{0x888888, 0.6, Dash::dashed};
constexpr double kLineWidth = 1.2;
constexpr double kOpacity = 0.8;  // so that marks of two series in one place are both seen
constexpr double kLegendRadius = 1.9;

Pen pen_of(const Series& series) { return {series.color, kLineWidth, series.dash}; }

void draw_panel(const DrawnPanel& panel, const Layout& layout, Canvas& canvas) {
  const Box& frame = panel.frame;
  for (const double x : layout.x_major)
    canvas.line({{frame.x + x, panel.finite_top}, {frame.x + x, frame.bottom()}}, kGrid);
  for (const double y : layout.y_major)
    canvas.line({{frame.x, frame.y + y}, {frame.right(), frame.y + y}}, kGrid);
  if (!panel.diagonal.empty()) canvas.line(panel.diagonal, kDiagonal);
  if (layout.infinity) {
    const double y = frame.y + layout.infinity_depth;
    canvas.line({{frame.x, y}, {frame.right(), y}}, kInfinityLine);
  }
  const auto tick = [&](double length, const Pen& pen, const std::vector<double>& xs,
                        const std::vector<double>& ys) {
    for (const double x : xs)
      canvas.line({{frame.x + x, frame.bottom()}, {frame.x + x, frame.bottom() + length}}, pen);
    for (const double y : ys) canvas.line({{frame.x, frame.y + y}, {frame.x - length, frame.y + y}}, pen);
  };
  tick(kTickLength, kFrame, layout.x_major, layout.y_major);
  tick(kTickLength * 0.6, kMinorTick, layout.x_minor, layout.y_minor);
  canvas.rectangle(frame, kFrame);
  for (const DrawnSeries& drawn : panel.series) {
    canvas.open(drawn.series->name);
    for (const std::vector<Spot>& line : drawn.lines) canvas.line(line, pen_of(*drawn.series));
    canvas.marks(drawn.marks, drawn.series->mark, drawn.radius, drawn.series->color,
                 drawn.lines.empty() ? kOpacity : 1);
    canvas.close();
  }
}

void draw(const Layout& layout, Canvas& canvas) {
  for (const DrawnPanel& panel : layout.panels) draw_panel(panel, layout, canvas);
  for (const LegendEntry& entry : layout.legend) {
    const Spot middle{entry.spot.x + layout.sample / 2, entry.spot.y};
    if (entry.series->draw == Draw::marks)
      canvas.marks({middle}, entry.series->mark, kLegendRadius, entry.series->color, kOpacity);
    else
      canvas.line({entry.spot, {entry.spot.x + layout.sample, entry.spot.y}}, pen_of(*entry.series));
  }
  for (const Line& line : layout.lines) canvas.text(line.spot, line.text, line.letters);
}

}  // namespace

void set_line_style(Series& series, std::size_t i) {
  constexpr Dash kDashes[] = {Dash::solid, Dash::dashed, Dash::dotted, Dash::dash_dot};
  series.color = kPalette[i % std::size(kPalette)];
  series.dash = kDashes[i / std::size(kPalette) % std::size(kDashes)];
}

void write_svg(const core::FileTarget& target, const Plot& plot) {
  drawing::Lettering lettering;
  const Layout layout = lay_out(plot, lettering);
  SvgCanvas canvas(layout.width, layout.height, plot.title, plot.metadata, lettering);
  draw(layout, canvas);
  core::write_file(target, canvas.finish());
}

void write_png(const core::FileTarget& target, const Plot& plot, int width) {
  if (width < 100 || width > 10'000)
    throw core::InvalidArgument("a plot cannot be " + std::to_string(width) +
                                " pixels wide, only 100 to 10000");
  drawing::Lettering lettering;
  const Layout layout = lay_out(plot, lettering);
  PixelCanvas canvas(layout.width, layout.height, width / layout.width, lettering);
  draw(layout, canvas);
  core::write_file(target, drawing::with_png_comment(canvas.png(), plot.metadata));
}

}  // namespace morsel::tools::plot
