#include "morsel/tools/render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools::render {
namespace {

using core::Point;

constexpr double kOpening = 24;  // degrees

/// To the picture's right, up, and to the viewer, in the front view.
std::array<Point, 3> axes(UpAxis up) {
  switch (up) {
    case UpAxis::x:
      return {Point::UnitZ(), Point::UnitX(), Point::UnitY()};
    case UpAxis::y:
      return {Point::UnitX(), Point::UnitY(), Point::UnitZ()};
    case UpAxis::z:
      return {Point::UnitX(), Point::UnitZ(), -Point::UnitY()};
  }
  throw core::InvalidArgument("an up axis that is none of x, y, z");
}

struct Named {
  std::string_view name;
  double azimuth;
  double elevation;
};
constexpr std::array<Named, 6> kViews = {{{"front", 0, 0},
                                          {"back", 180, 0},
                                          {"left", -90, 0},
                                          {"right", 90, 0},
                                          {"top", 0, 90},
                                          {"bottom", 0, -90}}};

/// Sine and cosine that are exact at quarter turns.
std::array<double, 2> turn(double degrees) {
  const double quarter = std::remainder(degrees, 360) / 90;
  if (quarter == std::round(quarter)) {
    const int q = static_cast<int>(quarter) & 3;
    return {q == 1 ? 1. : q == 3 ? -1. : 0., q == 0 ? 1. : q == 2 ? -1. : 0.};
  }
  return {std::sin(quarter * std::numbers::pi / 2), std::cos(quarter * std::numbers::pi / 2)};
}

}  // namespace

std::string to_string(UpAxis up) { return up == UpAxis::x ? "x" : up == UpAxis::y ? "y" : "z"; }

View view_at(double azimuth, double elevation, UpAxis up) {
  if (!std::isfinite(azimuth) || !(elevation >= -90 && elevation <= 90))
    throw core::InvalidArgument("a view's azimuth is a number of degrees, its elevation one from -90 to 90");
  const auto [right, top, front] = axes(up);
  const auto [sine, cosine] = turn(azimuth);
  const auto [rise, reach] = turn(elevation);
  const Point level = sine * right + cosine * front;
  return {reach * level + rise * top, reach * top - rise * level};
}

View view_from(const Point& toward, UpAxis up) {
  if (!(toward.norm() > 0) || !toward.allFinite()) throw core::InvalidArgument("a view needs a direction");
  const auto [right, top, front] = axes(up);
  const Point n = toward.normalized();
  Point upward = top - top.dot(n) * n;
  if (upward.norm() < 1e-6) upward = n.dot(top) > 0 ? Point(-front) : front;
  upward -= upward.dot(n) * n;
  return {n, upward.normalized()};
}

View named_view(std::string_view text, UpAxis up) {
  for (const Named& view : kViews)
    if (view.name == text) return view_at(view.azimuth, view.elevation, up);
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    std::vector<std::string> names = {"best"};
    for (const Named& view : kViews) names.emplace_back(view.name);
    throw core::InvalidArgument("there is no view \"" + std::string(text) + "\"" +
                                core::nearest_of(text, names, "there are") +
                                ", and azimuth/elevation in degrees such as 30/15");
  }
  return view_at(core::parse_number(text.substr(0, slash), "a view's azimuth"),
                 core::parse_number(text.substr(slash + 1), "a view's elevation"), up);
}

Camera fit_camera(std::span<const Point> points, const View& view, double aspect, double margin) {
  if (points.empty()) throw core::InvalidArgument("a camera cannot be fitted to no points");
  Camera camera;
  camera.back = view.toward;
  camera.up = view.up;
  camera.right = view.up.cross(view.toward);
  const double half = std::tan(kOpening / 2 * std::numbers::pi / 180);
  camera.half_width = aspect >= 1 ? half * aspect : half;
  camera.half_height = aspect >= 1 ? half : half / aspect;

  // Each side of the film is a plane through the eye that all points must be inside of. In coordinates (x, y,
  // z) along right, up and back: x + w z ≤ X + w Z, and so on, for the eye (X, Y, Z).
  const double w = camera.half_width * (1 - 2 * margin);
  const double h = camera.half_height * (1 - 2 * margin);
  constexpr double kLow = -std::numeric_limits<double>::infinity();
  double right = kLow, left = kLow, top = kLow, bottom = kLow, nearest = kLow;
  Point low = points.front(), high = points.front();
  for (const Point& p : points) {
    const double x = p.dot(camera.right), y = p.dot(camera.up), z = p.dot(camera.back);
    right = std::max(right, x + w * z);
    left = std::max(left, -x + w * z);
    top = std::max(top, y + h * z);
    bottom = std::max(bottom, -y + h * z);
    nearest = std::max(nearest, z);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high - low).norm();
  const double distance = std::max({(right + left) / (2 * w), (top + bottom) / (2 * h),
                                    nearest + (extent > 0 ? 1e-3 * extent : 1)});  // a point is in front, too
  camera.eye = (right - left) / 2 * camera.right + (top - bottom) / 2 * camera.up + distance * camera.back;
  return camera;
}

}  // namespace morsel::tools::render
