#pragma once
/// Critical points as spheres and arcs as tubes.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/tools/render/scene.h"

namespace morsel::tools::render {

/// Adds a sphere at each point, more than half of it above the surface. `places`, if not empty, are the
/// vertices to put them at instead.
void add_points(Scene& scene, const morse::CriticalPoints& points, double radius,
                std::span<const core::Index> places = {});

/// Adds the complex's arcs, or those of one kind, as tubes along the surface: with steps that arcs share
/// drawn once. Zigzags of edges and triangles are smoothed by averaging and projecting back to the surface;
/// no point is moved by more than `freedom` (in the body's unit; 0: not at all) and critical points not at
/// all: less than the radius keeps tubes on the borders of segments. Nothing is smoothed in triangles at a
/// vertex with more than 256 of them. `rays` are of the body alone. `complex` is one of the body's mesh,
/// whatever its size. O(length of what is drawn).
void add_arcs(Scene& scene, const Rays& rays, const mscomplex::MorseSmaleComplex& complex, double radius,
              double freedom = std::numeric_limits<double>::infinity(),
              std::optional<mscomplex::ArcKind> only = {});

}  // namespace morsel::tools::render
