#pragma once
/// Pictures in memory and as PNG files.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace morsel::tools::render {

/// Width and height in pixels.
struct Size {
  int width = 1200;
  int height = 900;
  friend bool operator==(const Size&, const Size&) = default;
};

inline constexpr int kLargestSide = 16384;  ///< of a picture

/// Throws InvalidArgument unless both sides are in 1 … kLargestSide and the picture has at most 100 million
/// pixels.
void check_size(Size size);

/// Four bytes a pixel: red, green, blue in sRGB, not multiplied by the fourth, opacity. Rows from the top.
struct Image {
  /// All pixels white, or without colour and fully transparent.
  Image(Size size, bool transparent);

  Size size;
  std::vector<std::uint8_t> bytes;

  const std::uint8_t* pixel(int x, int y) const {
    return &bytes[4 * (static_cast<std::size_t>(y) * size.width + x)];
  }
  std::uint8_t* pixel(int x, int y) { return &bytes[4 * (static_cast<std::size_t>(y) * size.width + x)]; }
};

/// The bytes of a PNG file of 8 bits a channel, without the fourth where all pixels are opaque. The same
/// bytes whenever libpng and zlib are the same.
std::string encode_png(const Image& image);

}  // namespace morsel::tools::render
