#pragma once
/// Colours: linear light to compute with, sRGB to store, OKLab to compare.

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace morsel::tools {

/// Linear light, red, green and blue of sRGB's primaries, in [0, 1].
using Color = Eigen::Vector3f;

/// 0xRRGGBB as web pages write it (sRGB).
Color from_hex(std::uint32_t hex);

/// sRGB, rounded to bytes and clamped to [0, 1].
std::array<std::uint8_t, 3> to_bytes(const Color& color);

/// Lightness in [0, 1] and two opponent axes, in which equal distances look about equal (Ottosson 2020).
Eigen::Vector3f to_oklab(const Color& color);
/// The inverse; may lie outside [0, 1].
Color from_oklab(const Eigen::Vector3f& lab);

}  // namespace morsel::tools
