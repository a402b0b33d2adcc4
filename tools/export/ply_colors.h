#pragma once
/// What MeshLab and Blender show of a PLY file: colours, and MeshLab's quality.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_writer.h"
#include "morsel/tools/color/surface_colors.h"

namespace morsel::tools {

/// The name under which MeshLab finds a value of each vertex.
inline constexpr const char* kQuality = "quality";

/// Colours as the properties red, green and blue (uchar), which both programs show.
class PlyColors {
 public:
  explicit PlyColors(std::span<const ColorBytes> colors);
  /// Appends views of them, unless a property has one of these names.
  void add_to(std::vector<core::PropertyView>& properties) const;

 private:
  std::array<std::vector<std::uint8_t>, 3> channels_;
};

/// Appends the property `quality` with these values unless one has that name.
void add_quality(std::vector<core::PropertyView>& properties, std::span<const double> values);

}  // namespace morsel::tools
