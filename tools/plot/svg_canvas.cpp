#include "morsel/tools/plot/svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/core/text/numbers.h"
#include "morsel/tools/formats/markup.h"

namespace morsel::tools::plot {
namespace {

/// With two decimals at most.
std::string number(double value) {
  std::string text = core::to_decimals(value, 2);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string pair(Spot spot) { return number(spot.x) + " " + number(spot.y); }

std::string hex(Color color) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4) text += kDigits[(color >> shift) & 0xf];
  return text;
}

std::string stroke(const Pen& pen) {
  std::string text =
      R"( fill="none" stroke=")" + hex(pen.color) + R"(" stroke-width=")" + number(pen.width) + "\"";
  std::string dashes;
  for (const double length : dash_lengths(pen.dash))
    dashes += (dashes.empty() ? "" : " ") + number(length * pen.width);
  if (!dashes.empty()) text += R"( stroke-dasharray=")" + dashes + "\"";
  return text;
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height, std::string_view title, std::string_view metadata,
                     drawing::Lettering& lettering)
    : lettering_(lettering) {
  const std::string w = number(width), h = number(height);
  document_ =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      R"(<svg xmlns="http://www.w3.org/2000/svg" role="img" width=")" +
      w + "pt\" height=\"" + h + "pt\" viewBox=\"0 0 " + w + " " + h +
      R"(" font-family="'DejaVu Sans', 'Bitstream Vera Sans', Verdana, sans-serif" stroke-linejoin="round">)"
      "\n";
  if (!title.empty()) document_ += "<title>" + markup_text(title) + "</title>\n";
  if (!metadata.empty()) document_ += "<metadata>" + std::string(metadata) + "</metadata>\n";
  document_ += "<rect width=\"" + w + "\" height=\"" + h + "\" fill=\"#ffffff\"/>\n";
}

void SvgCanvas::line(const std::vector<Spot>& spots, const Pen& pen) {
  if (spots.empty()) return;
  document_ += "<path d=\"M";
  for (std::size_t i = 0; i < spots.size(); ++i) document_ += (i == 0 ? "" : " ") + pair(spots[i]);
  document_ += "\"" + stroke(pen) + "/>\n";
}

void SvgCanvas::rectangle(const Box& box, const Pen& pen) {
  document_ += "<rect x=\"" + number(box.x) + "\" y=\"" + number(box.y) + "\" width=\"" + number(box.width) +
               "\" height=\"" + number(box.height) + "\"" + stroke(pen) + "/>\n";
}

void SvgCanvas::marks(const std::vector<Spot>& spots, Mark mark, double radius, Color color, double opacity) {
  if (spots.empty()) return;
  document_ += "<path d=\"";
  if (mark == Mark::disc) {  // strokes of no length with round ends: the shortest way to write many discs
    for (const Spot& spot : spots) document_ += "M" + pair(spot) + "h0";
    document_ += R"(" fill="none" stroke-linecap="round" stroke-width=")" + number(2 * radius) +
                 R"(" stroke=")" + hex(color) + R"(" stroke-opacity=")" + number(opacity);
  } else {
    const std::vector<Spot> corners = mark_corners(mark, radius);
    std::string outline = "l";  // from the first corner on, the same for all
    for (std::size_t i = 1; i < corners.size(); ++i)
      outline +=
          (i == 1 ? "" : " ") + pair({corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y});
    outline += "z";
    for (const Spot& spot : spots)
      document_ += "M" + pair({spot.x + corners[0].x, spot.y + corners[0].y}) + outline;
    document_ += R"(" fill=")" + hex(color) + R"(" fill-opacity=")" + number(opacity);
  }
  document_ += "\"/>\n";
}

void SvgCanvas::text(Spot spot, std::string_view text, const Letters& letters) {
  if (text.empty()) return;
  const std::string x = number(spot.x), y = number(spot.y);
  document_ += "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number(letters.size) + "\" fill=\"" +
               hex(letters.color) + "\" textLength=\"" + number(lettering_.width(text, letters.size)) +
               "\" lengthAdjust=\"spacingAndGlyphs\"";
  if (letters.align != Align::left)
    document_ += letters.align == Align::center ? R"( text-anchor="middle")" : R"( text-anchor="end")";
  if (letters.upwards) document_ += " transform=\"rotate(-90 " + x + " " + y + ")\"";
  document_ += ">" + markup_text(text) + "</text>\n";
}

void SvgCanvas::open(std::string_view name) {
  document_ += "<g>\n";
  if (!name.empty()) document_ += "<title>" + markup_text(name) + "</title>\n";
}

void SvgCanvas::close() { document_ += "</g>\n"; }

std::string SvgCanvas::finish() {
  document_ += "</svg>\n";
  return std::move(document_);
}

}  // namespace morsel::tools::plot
