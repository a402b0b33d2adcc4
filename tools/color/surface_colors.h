#pragma once
/// The colours that pictures give values, critical points and arcs, for the files of other programs.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/tools/color/color.h"

namespace morsel::tools {

/// Red, green and blue, sRGB.
using ColorBytes = std::array<std::uint8_t, 3>;

/// Of what has no value, such as a vertex that the mesh does not have.
inline constexpr std::uint32_t kNoColor = 0x808080;

/// The colours of values by the map and range that a picture takes without further options
/// (choose_scale()); kNoColor for those that are not finite. O(n).
std::vector<Color> value_colors(std::span<const double> values);
/// A colour for each number that is the place of one in `palette`; kNoColor for negative ones.
std::vector<Color> label_colors(std::span<const std::int32_t> labels, std::span<const Color> palette);

std::vector<ColorBytes> to_bytes(std::span<const Color> colors);

/// The paper's colours: minima blue, saddles green, maxima red.
Color color_of(morse::CriticalType type);
/// Descending arcs blue, ascending ones red.
Color color_of(mscomplex::ArcKind kind);

}  // namespace morsel::tools
