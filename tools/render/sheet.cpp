#include "morsel/tools/render/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/tools/color/color.h"
#include "morsel/tools/render/caption.h"

namespace morsel::tools::render {
namespace {

/// (a) … (z), (aa) …
std::string letter(std::size_t i) {
  std::string text;
  for (std::size_t n = i + 1; n > 0; n = (n - 1) / 26)
    text.insert(text.begin(), static_cast<char>('a' + (n - 1) % 26));
  return "(" + text + ") ";
}

}  // namespace

Image make_sheet(const std::vector<Panel>& panels, const std::string& title, bool transparent) {
  if (panels.empty()) throw core::InvalidArgument("a sheet needs a picture");
  const auto count = static_cast<int>(panels.size());
  const int columns = count <= 3 ? count : count == 4 ? 2 : 3;
  const int rows = (count + columns - 1) / columns;
  Size cell{1, 1};
  for (const Panel& panel : panels)
    cell = {std::max(cell.width, panel.image.size.width), std::max(cell.height, panel.image.size.height)};
  const double em = 1.15 * letter_size(cell);
  int strip = 0;
  for (const Panel& panel : panels) strip = std::max(strip, caption_height(panel.caption, em));
  const int gap = static_cast<int>(em);
  const int head = title.empty() ? 0 : static_cast<int>(2.4 * em);
  const auto length = [](int items, int size, int between, int more) {
    const std::int64_t sum = std::int64_t{items} * size + std::int64_t{items - 1} * between + more;
    return static_cast<int>(std::min<std::int64_t>(sum, 1 << 30));  // check_size() refuses that
  };
  const Size size{length(columns, cell.width, gap, 0), length(rows, cell.height + strip, gap, head)};
  Canvas canvas(size, transparent);
  if (head > 0) canvas.text(size.width / 2., 1.5 * em, 1.1 * em, title, Align::center);
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const int in_row = std::min(columns, count - i / columns * columns);  // the last row may be shorter
    const int indent = (columns - in_row) * (cell.width + gap) / 2;
    const int x = indent + (i % columns) * (cell.width + gap);
    const int y = head + (i / columns) * (cell.height + strip + gap);
    canvas.draw(panel.image, x + (cell.width - panel.image.size.width) / 2,
                y + (cell.height - panel.image.size.height) / 2);
    if (!panel.caption.empty())
      draw_caption(canvas, (count > 1 ? letter(static_cast<std::size_t>(i)) : "") + panel.caption, em, x,
                   y + cell.height, cell.width);
  }
  return canvas.image();
}

Image with_caption(const Image& image, const std::string& caption, bool transparent) {
  const double em = letter_size(image.size);
  Canvas canvas({image.size.width, image.size.height + caption_height(caption, em)}, transparent);
  canvas.draw(image, 0, 0);
  draw_caption(canvas, caption, em, 0, image.size.height, image.size.width);
  return canvas.image();
}

Image halved(const Image& image) {
  std::array<float, 256> linear;
  for (std::uint32_t i = 0; i < 256; ++i) linear[i] = from_hex(i << 16)[0];
  Image half({std::max(1, image.size.width / 2), std::max(1, image.size.height / 2)}, true);
  for (int y = 0; y < half.size.height; ++y)
    for (int x = 0; x < half.size.width; ++x) {
      Color sum = Color::Zero();
      float alpha = 0;
      for (int k = 0; k < 4; ++k) {
        const std::uint8_t* p = image.pixel(std::min(2 * x + k % 2, image.size.width - 1),
                                            std::min(2 * y + k / 2, image.size.height - 1));
        sum += static_cast<float>(p[3]) * Color(linear[p[0]], linear[p[1]], linear[p[2]]);
        alpha += static_cast<float>(p[3]);
      }
      if (alpha <= 0) continue;
      const auto rgb = to_bytes(sum / alpha);
      std::copy(rgb.begin(), rgb.end(), half.pixel(x, y));
      half.pixel(x, y)[3] = static_cast<std::uint8_t>(std::lround(alpha / 4));
    }
  return half;
}

}  // namespace morsel::tools::render
