#pragma once
/// Pictures side by side, as the panels of a figure.

#include <string>
#include <vector>

#include "morsel/tools/render/image.h"

namespace morsel::tools::render {

struct Panel {
  Image image;
  std::string caption;  ///< lines; the first is preceded by "(a) ", "(b) ", …
};

/// In rows of up to three (four panels: two rows of two), all cells as large as the largest picture, captions
/// below, an empty strip between; a title line above if there is a title. Throws InvalidArgument if there is
/// no panel, or so many that the sheet would be too large.
Image make_sheet(const std::vector<Panel>& panels, const std::string& title = {}, bool transparent = false);

/// A picture with a caption below, so much higher.
Image with_caption(const Image& image, const std::string& caption, bool transparent = false);

/// The image at half the width and height (rounded down, at least 1): each pixel the mean of four, in linear
/// light.
Image halved(const Image& image);

}  // namespace morsel::tools::render
