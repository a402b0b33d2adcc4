#pragma once
/// What a picture shows: a coloured surface, spheres and tubes.

#include <cstdint>
#include <variant>
#include <vector>

#include "morsel/tools/color/color.h"
#include "morsel/tools/color/colormap.h"
#include "morsel/tools/color/regions.h"
#include "morsel/tools/render/body.h"
#include "morsel/tools/render/rays.h"

namespace morsel::tools::render {

/// A value at each vertex, linear in between, looked up at every point: 0 is the map's lower end, 1 its
/// upper.
struct ValueColors {
  std::vector<float> values;
  Colormap map;
};

using SurfaceColors = std::variant<Color, ValueColors, RegionColors>;

/// Everything in the body's unit.
struct Scene {
  Body body;
  SurfaceColors surface = Color(0.7f, 0.7f, 0.7f);
  std::vector<Ball> balls = {};
  std::vector<Color> ball_colors = {};  ///< one each
  std::vector<Capsule> capsules = {};
  std::vector<Color> capsule_colors = {};
};

}  // namespace morsel::tools::render
