// Cameras of pictures.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/tools/render/best_view.h"
#include "morsel/tools/render/camera.h"

#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using namespace morsel::tools;
using namespace morsel::tools::render;

TEST_CASE("named views are exactly along the axes") {
  const Point x = Point::UnitX(), y = Point::UnitY(), z = Point::UnitZ();
  CHECK(named_view("front").toward == z);
  CHECK(named_view("front").up == y);
  CHECK(named_view("back").toward == -z);
  CHECK(named_view("left").toward == -x);
  CHECK(named_view("right").toward == x);
  CHECK(named_view("top").toward == y);
  CHECK(named_view("top").up == -z);
  CHECK(named_view("bottom").toward == -y);
  CHECK(named_view("bottom").up == z);
  CHECK(named_view("90/0").toward == x);
  CHECK(named_view("front", UpAxis::z).toward == -y);
  CHECK(named_view("front", UpAxis::z).up == z);
  CHECK(named_view("right", UpAxis::z).toward == x);
  CHECK(named_view("front", UpAxis::x).toward == y);
  CHECK(named_view("front", UpAxis::x).up == x);
  CHECK((named_view("45/0").toward - (x + z) / std::sqrt(2)).norm() < 1e-15);
  CHECK(named_view("0/30").toward.y() == Approx(0.5));
  for (const char* wrong : {"", "best", "Front", "1/2/3", "0/91", "/", "nan/0", "30"})
    CHECK_THROWS_AS(named_view(wrong), core::InvalidArgument);
}

TEST_CASE("views along a direction keep the up axis upwards") {
  for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z})
    for (const Point& toward :
         {Point(1, 2, 3), Point(0, 5, 0), Point(0, 0, -1), Point(-1, 0, 0), Point(1e-9, 1, 0)}) {
      const View view = view_from(toward, up);
      CHECK(view.toward.norm() == Approx(1));
      CHECK(view.up.norm() == Approx(1));
      CHECK(std::abs(view.up.dot(view.toward)) < 1e-12);
      CHECK(view.toward.dot(toward.normalized()) == Approx(1));
      CHECK(view.up[static_cast<int>(up)] >= -1e-12);
    }
  CHECK_THROWS_AS(view_from(Point::Zero()), core::InvalidArgument);
}

TEST_CASE("a fitted camera sees all points, no farther away than it must be") {
  for (const auto& [name, mesh] : mesh_zoo())
    for (const char* text : {"front", "top", "30/20", "200/-70"})
      for (const double aspect : {1., 1.5, 0.4}) {
        CAPTURE(name, text, aspect);
        const double margin = 0.05;
        const Camera camera = fit_camera(mesh.positions(), named_view(text), aspect, margin);
        CHECK(camera.half_width / camera.half_height == Approx(aspect));
        CHECK((camera.right - camera.up.cross(camera.back)).norm() < 1e-12);
        double x = 0, y = 0;
        for (const Point& p : mesh.positions()) {
          const Eigen::Vector2d at = camera.project(p);
          x = std::max(x, std::abs(at[0]));
          y = std::max(y, std::abs(at[1]));
        }
        CHECK(std::max(x, y) == Approx(1 - 2 * margin).epsilon(1e-9));
      }
}

TEST_CASE("a single point can be looked at") {
  const std::vector<Point> one = {Point(3, 4, 5)};
  const Camera camera = fit_camera(one, named_view("front"), 1);
  CHECK(camera.project(one[0]).norm() < 1e-12);
  CHECK_THROWS_AS(fit_camera({}, named_view("front"), 1), core::InvalidArgument);
}

TEST_CASE("rays go through the points that they were projected from") {
  const std::vector<Point> points = {Point(0, 0, 0), Point(1, 2, 0), Point(-1, 0.5, 3)};
  const Camera camera = fit_camera(points, named_view("40/25"), 1.3);
  for (const Point& p : points) {
    const Eigen::Vector2d at = camera.project(p);
    CHECK(camera.direction(at[0], at[1]).normalized().dot((p - camera.eye).normalized()) ==
          Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("the best view shows the largest weights, unless they are occluded") {
  const Body ball = make_body(sphere(3).mesh());
  const Rays rays(ball.mesh);
  for (const Point& side :
       {Point(1, 0, 0), Point(-0.6, 0.2, 0.8).normalized().eval(), Point(0, 0.3, -1).normalized().eval()}) {
    std::vector<double> weights;
    for (const Point& p : ball.mesh.positions()) weights.push_back(p.normalized().dot(side) > 0.8 ? 1 : 0.01);
    CHECK(best_view(ball, rays, weights).toward.dot(side) > 0.98);
  }
  // Two balls; the side that the first turns to the second carries the weight, but cannot be seen from there.
  Soup second = sphere(3);
  for (Point& p : second.positions) p = 3 * p + Point(4.5, 0, 0);
  const Body two = make_body(together(sphere(3), second).mesh());
  const Rays both(two.mesh);
  std::vector<double> weights;
  for (std::size_t v = 0; v < two.mesh.vertex_count(); ++v)
    weights.push_back(v < 642 && two.normals[v].x() > 0.8 ? 1 : 0);
  const Point toward = best_view(two, both, weights).toward;
  CHECK(toward.x() < 0.9);
  CHECK_THROWS_AS(best_view(two, both, std::vector<double>(3, 1)), core::InvalidArgument);
}
