#pragma once
/// The font of plots and pictures, and the width of texts in it.

#include <string>
#include <string_view>

// cairo's types, whose header users of the library need not have.
using cairo_t = struct _cairo;                  // NOLINT(bugprone-reserved-identifier)
using cairo_surface_t = struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier)

namespace morsel::tools::drawing {

/// DejaVu Sans as it is built into the program, so that nothing drawn depends on the fonts of the machine.
/// One for each drawing: neither cairo's fonts nor FreeType's may be used by several threads.
class Lettering {
 public:
  Lettering();
  ~Lettering();  // NOLINT(performance-trivially-destructible): not where there is a font
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  /// The width of a line of UTF-8, in the unit of `size`, the size of the em. Throws InvalidArgument if it is
  /// not UTF-8.
  double width(std::string_view text, double size);
  /// The text, or as much of its beginning as fits into `limit` with an ellipsis.
  std::string shortened(std::string_view text, double size, double limit);

  /// Chooses the font for drawing: outlines as they are, not fitted to pixels.
  void use(cairo_t* context, double size);

 private:
  [[maybe_unused]] cairo_surface_t* surface_;
  [[maybe_unused]] cairo_t* context_;
};

/// Throws InvalidArgument unless it is UTF-8 without control characters, which neither cairo nor XML takes.
void check_text(std::string_view text);

}  // namespace morsel::tools::drawing
