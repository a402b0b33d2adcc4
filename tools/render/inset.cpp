#include "morsel/tools/render/inset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "morsel/core/error.h"

namespace morsel::tools::render {
namespace {

struct Square {
  int x, y, side;
};

/// How many of its pixels show the surface.
std::size_t hidden(const Image& picture, const Square& at) {
  std::size_t count = 0;
  for (int y = at.y; y < at.y + at.side; ++y)
    for (int x = at.x; x < at.x + at.side; ++x) {
      const std::uint8_t* p = picture.pixel(x, y);
      count += p[3] > 0 && (p[0] & p[1] & p[2]) < 255 ? 1 : 0;
    }
  return count;
}

/// The area of the intersection of two squares.
double overlap(const Square& a, double x, double y, double side) {
  const double w = std::min(a.x + a.side, static_cast<int>(x + side)) - std::max<double>(a.x, x);
  const double h = std::min(a.y + a.side, static_cast<int>(y + side)) - std::max<double>(a.y, y);
  return std::max(0., w) * std::max(0., h);
}

void check_radius(double radius) {
  if (!(radius > 1e-4 && radius <= 1))
    throw core::InvalidArgument(
        "the radius of a magnified region is above 0.01 % of the mesh's diagonal and at most all of it");
}

}  // namespace

FilmWindow window_around(const Camera& camera, const core::Point& center, double radius) {
  check_radius(radius);
  const Eigen::Vector2d middle = camera.project(center);
  const double depth = (camera.eye - center).dot(camera.back);
  const double reach = radius / (depth * std::min(camera.half_width, camera.half_height));
  return {middle[0] - reach, middle[1] - reach, middle[0] + reach, middle[1] + reach};
}

void draw_window(Canvas& canvas, Size picture, const FilmWindow& window, double em) {
  const double x = (window.x0 + 1) / 2 * picture.width, y = (1 - window.y1) / 2 * picture.height;
  const double width = (window.x1 - window.x0) / 2 * picture.width;
  const double height = (window.y1 - window.y0) / 2 * picture.height;
  canvas.frame(x, y, width, height, std::max(1.5, em / 6), kBlack);
}

void draw_inset(Canvas& canvas, const Image& picture, const Tracer& tracer, const Camera& camera,
                const TraceOptions& options, const core::Point& center, double radius, double em,
                const core::Progress& progress) {
  check_radius(radius);
  const auto [width, height] = picture.size;
  const int side = static_cast<int>(0.36 * std::min(width, height));
  if (side < 24) throw core::InvalidArgument("the picture is too small to magnify a region in it");

  const Eigen::Vector2d middle = camera.project(center);
  const double depth = (camera.eye - center).dot(camera.back);
  const double half_x = radius / (depth * camera.half_width);
  const double half_y = radius / (depth * camera.half_height);
  const double region_x = (middle[0] - half_x + 1) / 2 * width;
  const double region_y = (1 - middle[1] - half_y) / 2 * height;
  const double region = half_x * width;  // side in pixels

  const int gap = static_cast<int>(0.8 * em);
  std::array<Square, 4> corners = {{{gap, gap, side},
                                    {width - side - gap, gap, side},
                                    {gap, height - side - gap, side},
                                    {width - side - gap, height - side - gap, side}}};
  const Square at = *std::min_element(corners.begin(), corners.end(), [&](const Square& a, const Square& b) {
    // Hiding the region itself is worse than hiding anything else.
    const auto cost = [&](const Square& s) {
      return static_cast<double>(hidden(picture, s)) + 1e6 * overlap(s, region_x, region_y, region);
    };
    return cost(a) < cost(b);
  });

  TraceOptions close = options;
  close.size = {side, side};
  close.window = {middle[0] - half_x, middle[1] - half_y, middle[0] + half_x, middle[1] + half_y};
  const Image image = tracer.trace(camera, close, progress);

  const double thickness = std::max(1., em / 12);
  canvas.frame(region_x, region_y, region, region, thickness, kGray);
  // Of the four lines from corner to corner the two outer ones, which cross neither frame.
  const bool right = at.x > region_x, below = at.y > region_y;
  const auto lead = [&](bool at_right, bool at_bottom) {
    canvas.line(region_x + (at_right ? region : 0), region_y + (at_bottom ? region : 0),
                at.x + (at_right ? side : 0), at.y + (at_bottom ? side : 0), thickness, kGray);
  };
  lead(right == below, false);
  lead(right != below, true);
  if (!options.transparent) canvas.fill(at.x, at.y, side, side, 0xffffff);
  canvas.draw(image, at.x, at.y);
  canvas.frame(at.x + 0.5, at.y + 0.5, side - 1, side - 1, 1.5 * thickness, kGray);
}

}  // namespace morsel::tools::render
