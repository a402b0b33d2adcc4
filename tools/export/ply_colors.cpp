#include "morsel/tools/export/ply_colors.h"

#include <algorithm>

namespace morsel::tools {
namespace {

constexpr std::array kChannels = {"red", "green", "blue"};

bool has(const std::vector<core::PropertyView>& properties, const std::string& name) {
  return std::ranges::find(properties, name, &core::PropertyView::name) != properties.end();
}

}  // namespace

PlyColors::PlyColors(std::span<const ColorBytes> colors) {
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    channels_[channel].reserve(colors.size());
    for (const ColorBytes& color : colors) channels_[channel].push_back(color[channel]);
  }
}

void PlyColors::add_to(std::vector<core::PropertyView>& properties) const {
  if (std::ranges::any_of(kChannels, [&](const char* name) { return has(properties, name); })) return;
  for (std::size_t channel = 0; channel < channels_.size(); ++channel)
    properties.emplace_back(kChannels[channel], std::span<const std::uint8_t>(channels_[channel]));
}

void add_quality(std::vector<core::PropertyView>& properties, std::span<const double> values) {
  if (!has(properties, kQuality)) properties.emplace_back(kQuality, values);
}

}  // namespace morsel::tools
