#pragma once
/// The camera of a picture.

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "morsel/core/mesh/mesh.h"

namespace morsel::tools::render {

/// The axis of a mesh that points up.
enum class UpAxis { x, y, z };
std::string to_string(UpAxis up);

/// Unit vectors: from the surface to the camera, and what is up in the picture (perpendicular to it).
struct View {
  core::Point toward = core::Point::UnitZ();
  core::Point up = core::Point::UnitY();
};

/// From azimuth and elevation in degrees, elevation in [−90, 90]. Azimuth 0 looks at the front and grows to
/// the mesh's left, the picture's right:
///
///   up y (the default): front from +z, right side of the picture +x; back from −z, left −x, right +x,
///                       top +y, bottom −y
///   up z: front from −y, right side of the picture +x; up x: front from +y, right side of the picture +z
View view_at(double azimuth, double elevation, UpAxis up = UpAxis::y);
/// The view along a direction, of any length but zero, with `up` up as far as possible.
View view_from(const core::Point& toward, UpAxis up = UpAxis::y);

/// "front", "back", "left", "right", "top", "bottom" or "azimuth/elevation" in degrees. Throws
/// InvalidArgument, listing the views, on anything else ("best", which depends on the mesh, included).
View named_view(std::string_view text, UpAxis up = UpAxis::y);

/// A pinhole camera. The film is the square [−1, 1]² or a part of it, x to the right, y up.
struct Camera {
  core::Point eye;
  core::Point right;
  core::Point up;
  core::Point back;       ///< against the direction of sight
  double half_width = 1;  ///< of the film, at distance 1
  double half_height = 1;

  /// Film coordinates; the point must be in front of the camera.
  Eigen::Vector2d project(const core::Point& point) const {
    const core::Point p = point - eye;
    const double depth = -p.dot(back);
    return {p.dot(right) / (depth * half_width), p.dot(up) / (depth * half_height)};
  }
  /// Of the ray through a point of the film, not of unit length: 1 along the direction of sight.
  core::Point direction(double x, double y) const {
    return x * half_width * right + y * half_height * up - back;
  }
};

/// The closest camera that looks along the view and has all points on its film, `margin` (a share of the
/// film) clear on every side; the smaller side sees 24°. `aspect` is width over height. Exact; O(n). Points:
/// one or more.
Camera fit_camera(std::span<const core::Point> points, const View& view, double aspect, double margin = 0.04);

}  // namespace morsel::tools::render
