#include "support/refinement.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "morsel/core/error.h"
#include "morsel/core/mesh/subdivision.h"

using namespace morsel;

TEST_CASE("cutting every edge keeps the surface and multiplies triangles") {
  for (const auto& [name, mesh] : test::mesh_zoo())
    for (const int pieces : {1, 2, 3, 5}) {
      CAPTURE(name, pieces);
      const auto finer = test::refined(mesh, pieces).mesh();
      finer.validate();
      CHECK(finer.triangle_count() == mesh.triangle_count() * pieces * pieces);
      CHECK(finer.euler_characteristic() == mesh.euler_characteristic());
      CHECK(finer.boundary_loop_count() == mesh.boundary_loop_count());
      CHECK(finer.bounding_box().diagonal() == Approx(mesh.bounding_box().diagonal()));
      for (core::Index v = 0; v < mesh.vertex_count(); ++v) REQUIRE(finer.position(v) == mesh.position(v));
      const auto area = [](const core::TriangleMesh& m) {
        double sum = 0;
        for (const core::Triangle& t : m.triangles())
          sum += (m.position(t[1]) - m.position(t[0])).cross(m.position(t[2]) - m.position(t[0])).norm() / 2;
        return sum;
      };
      CHECK(area(finer) == Approx(area(mesh)));
    }
}

TEST_CASE("edges cannot be cut into no pieces") {
  CHECK_THROWS_AS(core::subdivided(test::tetrahedron().mesh(), 0), core::InvalidArgument);
}

TEST_CASE("noise is bounded by its share of the mean edge and repeats with its seed") {
  const auto soup = test::sphere(3);
  auto a = soup;
  auto b = soup;
  auto c = soup;
  test::add_noise(a, 0.05, 1);
  test::add_noise(b, 0.05, 1);
  test::add_noise(c, 0.05, 2);
  CHECK(a.positions == b.positions);
  CHECK(a.positions != c.positions);
  double most = 0;
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    most = std::max(most, (a.positions[v] - soup.positions[v]).cwiseAbs().maxCoeff());
  const double edge = (soup.positions[soup.triangles[0][0]] - soup.positions[soup.triangles[0][1]]).norm();
  CHECK(most > 0.04 * edge);
  CHECK(most < 0.06 * edge);
}
