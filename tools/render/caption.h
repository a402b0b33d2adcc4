#pragma once
/// Lines of text below pictures.

#include <string>

#include "morsel/tools/render/canvas.h"
#include "morsel/tools/render/image.h"

namespace morsel::tools::render {

/// The size of letters for a picture of this size.
double letter_size(Size size);

/// The height of a caption's strip; 0 if it is empty. Lines are separated by \\n.
int caption_height(const std::string& text, double em);
/// Draws it in the middle of [x, x + width] from y on: the first line black, the others grey.
void draw_caption(Canvas& canvas, const std::string& text, double em, double x, double y, double width);

/// "1,895 critical points: 462 minima, 934 saddles, 499 maxima"
std::string counts_line(std::size_t minima, std::size_t saddles, std::size_t maxima);

}  // namespace morsel::tools::render
