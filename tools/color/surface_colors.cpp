#include "morsel/tools/color/surface_colors.h"

#include <algorithm>
#include <cmath>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/color/value_scale.h"

namespace morsel::tools {

std::vector<Color> value_colors(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  std::vector<Color> colors(values.size(), from_hex(kNoColor));
  if (finite.empty()) return colors;
  // Of a quarter of them where the range would be more than a double can hold; the colours are the same.
  const bool is_huge = std::ranges::any_of(finite, [](double value) { return std::abs(value) > 1e307; });
  const double factor = is_huge ? 0.25 : 1;
  for (double& value : finite) value *= factor;
  const ValueScale scale = choose_scale(finite);
  core::parallel_for_each(values.size(), [&](std::size_t i) {
    if (std::isfinite(values[i])) colors[i] = scale.map(scale.position(factor * values[i]));
  });
  return colors;
}

std::vector<Color> label_colors(std::span<const std::int32_t> labels, std::span<const Color> palette) {
  std::vector<Color> colors;
  colors.reserve(labels.size());
  for (const std::int32_t label : labels)
    colors.push_back(label < 0 ? from_hex(kNoColor) : palette[static_cast<std::size_t>(label)]);
  return colors;
}

std::vector<ColorBytes> to_bytes(std::span<const Color> colors) {
  std::vector<ColorBytes> bytes(colors.size());
  core::parallel_for_each(colors.size(), [&](std::size_t i) { bytes[i] = to_bytes(colors[i]); });
  return bytes;
}

Color color_of(morse::CriticalType type) {
  switch (type) {
    case morse::CriticalType::minimum:
      return from_hex(0x1f4fd0);
    case morse::CriticalType::maximum:
      return from_hex(0xd01c1f);
    default:
      return from_hex(0x1fa040);
  }
}

Color color_of(mscomplex::ArcKind kind) {
  return from_hex(kind == mscomplex::ArcKind::descending ? 0x24425f : 0x6b2a24);
}

}  // namespace morsel::tools
