#include "morsel/tools/color/colormap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"

namespace morsel::tools {
namespace {

using Lab = Eigen::Vector3f;

constexpr int kSteps = 1024;

constexpr std::array<std::uint32_t, 33> kViridis = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b,
    0x375a8d, 0x33638d, 0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908c, 0x1f988b,
    0x1f9f88, 0x21a685, 0x28ae80, 0x31b57b, 0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c,
    0x96d83f, 0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725};
constexpr std::array<std::uint32_t, 33> kCividis = {
    0x00224e, 0x00285b, 0x002e6a, 0x043371, 0x1a386f, 0x273e6e, 0x32436d, 0x3b496c, 0x434e6c,
    0x4b546c, 0x52596d, 0x5a5f6e, 0x61656f, 0x686a71, 0x6f7073, 0x757676, 0x7c7b78, 0x848179,
    0x8b8778, 0x938d78, 0x9b9376, 0xa39a75, 0xaba072, 0xb3a670, 0xbbad6c, 0xc3b469, 0xccba64,
    0xd4c15f, 0xddc958, 0xe6d051, 0xefd748, 0xf8df3c, 0xfee838};

/// Lightness, chroma and hue in degrees.
Lab lch(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180;
  return {static_cast<float>(lightness), static_cast<float>(chroma * std::cos(angle)),
          static_cast<float>(chroma * std::sin(angle))};
}

const Lab kWhite = lch(0.955, 0, 0);

/// Straight from point to point in OKLab.
std::vector<Color> through(std::span<const Lab> points) {
  std::vector<Color> table(kSteps + 1);
  const auto legs = static_cast<double>(points.size() - 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double x = legs * i / kSteps;
    const auto leg = std::min(static_cast<std::size_t>(x), points.size() - 2);
    const auto f = static_cast<float>(x - static_cast<double>(leg));
    table[i] = from_oklab((1 - f) * points[leg] + f * points[leg + 1]).cwiseMax(0.f).cwiseMin(1.f);
  }
  return table;
}

std::vector<Color> through_hex(std::span<const std::uint32_t> colors) {
  std::vector<Lab> points;
  for (const std::uint32_t hex : colors) points.push_back(to_oklab(from_hex(hex)));
  return through(points);
}

struct Entry {
  std::string_view name;
  bool diverging;
  std::vector<Color> (*make)();
};

constexpr std::array<Entry, 5> kMaps = {{
    {"blue-orange", true,
     [] {
       return through(std::array{lch(0.56, 0.150, 257), kWhite, lch(0.56, 0.135, 52)});
     }},
    {"purple-green", true,
     [] {
       return through(std::array{lch(0.52, 0.170, 302), kWhite, lch(0.52, 0.130, 142)});
     }},
    {"viridis", false, [] { return through_hex(kViridis); }},
    {"cividis", false, [] { return through_hex(kCividis); }},
    {"sand", false,
     [] {
       return through(std::array{lch(0.955, 0.020, 95), lch(0.74, 0.095, 70), lch(0.525, 0.125, 40)});
     }},
}};

}  // namespace

Colormap::Colormap(std::string_view name) : name_(name) {
  const auto* const found =
      std::find_if(kMaps.begin(), kMaps.end(), [&](const Entry& e) { return e.name == name; });
  if (found == kMaps.end())
    throw core::InvalidArgument("there is no colour map \"" + name_ + "\"" +
                                core::nearest_of(name_, colormap_names(), "there are"));
  diverging_ = found->diverging;
  table_ = found->make();
}

Color Colormap::operator()(double t) const {
  const double x = std::clamp(t, 0., 1.) * kSteps;
  const auto i = std::min(static_cast<std::size_t>(x), std::size_t{kSteps - 1});
  const auto f = static_cast<float>(x - static_cast<double>(i));
  return (1 - f) * table_[i] + f * table_[i + 1];
}

std::vector<std::string> colormap_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kMaps) names.emplace_back(entry.name);
  return names;
}

}  // namespace morsel::tools
