#include "morsel/tools/render/caption.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace morsel::tools::render {
namespace {

constexpr double kLine = 1.4;  // ems from baseline to baseline

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string counted(std::size_t number, const char* one, const char* many) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text + (number == 1 ? one : many);
}

}  // namespace

double letter_size(Size size) {
  return std::clamp(std::sqrt(double{1} * size.width * size.height) / 58, 9., 60.);
}

int caption_height(const std::string& text, double em) {
  if (text.empty()) return 0;
  return static_cast<int>(std::ceil((kLine * static_cast<double>(lines_of(text).size()) + 0.9) * em));
}

void draw_caption(Canvas& canvas, const std::string& text, double em, double x, double y, double width) {
  Ink ink = kBlack;
  double baseline = y + 1.2 * em;
  for (const std::string& line : lines_of(text)) {
    const double fit =
        std::min(1., 0.97 * width / canvas.text_width(em, line));  // or it would run into its neighbour
    canvas.text(x + width / 2, baseline, fit * em, line, Align::center, ink);
    baseline += kLine * em;
    ink = kGray;
  }
}

std::string counts_line(std::size_t minima, std::size_t saddles, std::size_t maxima) {
  return counted(minima + saddles + maxima, " critical point: ", " critical points: ") +
         counted(minima, " minimum, ", " minima, ") + counted(saddles, " saddle, ", " saddles, ") +
         counted(maxima, " maximum", " maxima");
}

}  // namespace morsel::tools::render
