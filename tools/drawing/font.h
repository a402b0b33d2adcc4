#pragma once
/// The bytes of the font of pictures and plots.

#include <cstddef>

namespace morsel::tools::drawing {

/// DejaVu Sans, a TrueType file; made by CMake from the file it finds.
extern const char* const kFontBytes;
extern const std::size_t kFontSize;

}  // namespace morsel::tools::drawing
