#include "morsel/tools/color/color.h"

#include <algorithm>
#include <cmath>

namespace morsel::tools {
namespace {

float decoded(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }
float encoded(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

}  // namespace

Color from_hex(std::uint32_t hex) {
  const auto channel = [hex](int shift) { return decoded(static_cast<float>((hex >> shift) & 0xff) / 255); };
  return {channel(16), channel(8), channel(0)};
}

std::array<std::uint8_t, 3> to_bytes(const Color& color) {
  const auto channel = [&](int i) {
    return static_cast<std::uint8_t>(std::lround(255 * encoded(std::clamp(color[i], 0.f, 1.f))));
  };
  return {channel(0), channel(1), channel(2)};
}

Eigen::Vector3f to_oklab(const Color& c) {
  const float l = std::cbrt(0.4122214708f * c[0] + 0.5363325363f * c[1] + 0.0514459929f * c[2]);
  const float m = std::cbrt(0.2119034982f * c[0] + 0.6806995451f * c[1] + 0.1073969566f * c[2]);
  const float s = std::cbrt(0.0883024619f * c[0] + 0.2817188376f * c[1] + 0.6299787005f * c[2]);
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
          1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
          0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

Color from_oklab(const Eigen::Vector3f& lab) {
  const auto cube = [](float x) { return x * x * x; };
  const float l = cube(lab[0] + 0.3963377774f * lab[1] + 0.2158037573f * lab[2]);
  const float m = cube(lab[0] - 0.1055613458f * lab[1] - 0.0638541728f * lab[2]);
  const float s = cube(lab[0] - 0.0894841775f * lab[1] - 1.2914855480f * lab[2]);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

}  // namespace morsel::tools
