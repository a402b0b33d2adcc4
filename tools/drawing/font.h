#pragma once
/// The bytes of the font of pictures and plots.

#include <span>
#include <string_view>

namespace morsel::tools::drawing {

/// DejaVu Sans, a TrueType file, in pieces: compilers need not take string literals of more than 65,536 bytes.
/// Made by CMake from the file it finds.
extern const std::span<const std::string_view> kFontPieces;

}  // namespace morsel::tools::drawing
