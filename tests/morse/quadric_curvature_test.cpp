#include "morsel/morse/functions/quadric_curvature.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "support/fields.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using morse::QuadricCurvatures;

TEST_CASE("a quadric is found exactly") {
  // z = (3x² − y²)/2 + 0.4xy over two rings of a disc: the Hessian's eigenvalues, bending towards the normal
  // as −.
  const Soup disc = wheel(6);
  Soup soup;
  soup.positions.emplace_back(0, 0, 0);
  const auto on = [](double x, double y) { return Point(x, y, (3 * x * x - y * y) / 2 + 0.4 * x * y); };
  for (const double r : {0.5, 1.0})
    for (int j = 0; j < 6; ++j)
      soup.positions.push_back(on(r * std::cos(j * M_PI / 3), r * std::sin(j * M_PI / 3)));
  soup.triangles = disc.triangles;
  for (Index j = 0; j < 6; ++j) {
    const Index next = (j + 1) % 6;
    soup.triangles.push_back({1 + j, 7 + j, 7 + next});
    soup.triangles.push_back({1 + j, 7 + next, 1 + next});
  }
  const QuadricCurvatures fitted = morse::quadric_curvatures(soup.mesh(), 3);
  const double root = std::sqrt(4 + 0.16);
  CHECK(fitted.curvatures.k1[0] == Approx(-1 + root));
  CHECK(fitted.curvatures.k2[0] == Approx(-1 - root));
  CHECK(fitted.unfitted == 0);
  CHECK(fitted.widened == 0);
}

TEST_CASE("fitted quadrics on sphere plane and cylinder") {
  for (const bool inward : {false, true}) {
    const TriangleMesh mesh = scaled((inward ? inside_out(sphere(4)) : sphere(4)).mesh(), 20);
    const QuadricCurvatures fitted = morse::quadric_curvatures(mesh, 4);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(fitted.curvatures.k1[v] == Approx(0.05).epsilon(0.02));
      CHECK(fitted.curvatures.k2[v] == Approx(0.05).epsilon(0.02));
    }
    CHECK(fitted.widened == 0);
  }
  const QuadricCurvatures plane = morse::quadric_curvatures(grid(9, 8).mesh(), 2.5);
  for (std::size_t v = 0; v < 72; ++v) {
    CHECK(plane.curvatures.k1[v] == Approx(0).margin(1e-14));
    CHECK(plane.curvatures.k2[v] == Approx(0).margin(1e-14));
  }
  constexpr int kAround = 60;
  const QuadricCurvatures tube = morse::quadric_curvatures(cylinder(2.5, kAround, 11).mesh(), 0.7);
  for (std::size_t v = 3 * kAround; v < 8 * kAround; ++v) {
    CHECK(tube.curvatures.k1[v] == Approx(0.4).epsilon(0.02));
    CHECK(tube.curvatures.k2[v] == Approx(0).margin(1e-3));
  }
}

TEST_CASE("fitted quadrics on a torus come near the smooth curvatures and withstand noise") {
  const TriangleMesh smooth = torus(180, 90).mesh();
  const auto worst = [&](const TriangleMesh& mesh, const morse::PrincipalCurvatures& k) {
    double most = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double c = std::cos(2 * M_PI * (v % 90) / 90);
      most = std::max({most, std::abs(k.k1[v] - 1), std::abs(k.k2[v] - c / (2 + c))});
    }
    return most;
  };
  CHECK(worst(smooth, morse::quadric_curvatures(smooth, 0.25).curvatures) < 0.03);
  const TriangleMesh noisy = jittered(smooth, 0.005, 3);
  const double fitted = worst(noisy, morse::quadric_curvatures(noisy, 0.4).curvatures);
  CHECK(fitted < 0.3);
  CHECK(10 * fitted < worst(noisy, morse::principal_curvatures(noisy)));
}

TEST_CASE("a fitted quadric ignores a near sheet") {
  // Two grids of 11 × 11 vertices of side 1, bent upwards and downwards, 0.2 apart.
  Soup lower = grid(11, 11);
  Soup upper = grid(11, 11);
  const Point middle = lower.positions[60];
  for (std::size_t v = 0; v < 121; ++v) {
    const double square = (lower.positions[v] - middle).squaredNorm();
    lower.positions[v].z() = -0.01 * square;
    upper.positions[v].z() = 0.2 + 0.01 * square;
  }
  const TriangleMesh both = together(lower, upper).mesh();
  const QuadricCurvatures together = morse::quadric_curvatures(both, 3);
  const QuadricCurvatures alone = morse::quadric_curvatures(lower.mesh(), 3);
  for (std::size_t v = 0; v < 121; ++v)
    CHECK(together.curvatures.k1[v] == Approx(alone.curvatures.k1[v]).margin(1e-12));
  CHECK(together.curvatures.k1[60] == Approx(0.02).epsilon(0.05));
}

TEST_CASE("balls with too few vertices become rings and what no quadric fits keeps Taubin's curvature") {
  const TriangleMesh mesh = sphere(3).mesh();
  const QuadricCurvatures tiny = morse::quadric_curvatures(mesh, 1e-300);
  CHECK(tiny.widened == mesh.vertex_count());
  CHECK(tiny.unfitted == 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(tiny.curvatures.k1[v] == Approx(1).epsilon(0.05));

  const TriangleMesh small =
      octahedron().mesh();  // its six vertices lie on two conics as seen from any of them
  const QuadricCurvatures few = morse::quadric_curvatures(small, 10);
  CHECK(few.unfitted == 6);
  CHECK(few.curvatures.k1 == morse::principal_curvatures(small).k1);
  CHECK(few.curvatures.k2 == morse::principal_curvatures(small).k2);

  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  const QuadricCurvatures nothing = morse::quadric_curvatures(point, 1);
  CHECK(nothing.unfitted == mesh.vertex_count());
  CHECK(nothing.curvatures.k1[5] == 0);
}

TEST_CASE("fitted quadrics turn with the mesh and scale exactly by powers of two") {
  const TriangleMesh mesh = jittered(torus(24, 17).mesh(), 0.05, 5);
  const QuadricCurvatures before = morse::quadric_curvatures(mesh, 1.1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  const QuadricCurvatures turned = morse::quadric_curvatures(moved(mesh, 3 * turn, {7, -4, 2}), 3.3);
  const QuadricCurvatures tiny = morse::quadric_curvatures(scaled(mesh, 0x1p-800), 1.1 * 0x1p-800);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(3 * turned.curvatures.k1[v] == Approx(before.curvatures.k1[v]).margin(1e-10));
    CHECK(3 * turned.curvatures.k2[v] == Approx(before.curvatures.k2[v]).margin(1e-10));
    CHECK(tiny.curvatures.k1[v] == before.curvatures.k1[v] * 0x1p800);
  }
}

TEST_CASE("fitted quadrics are the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 4);
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return morse::quadric_curvatures(mesh, 0.2).curvatures;
  };
  const auto one = run(1);
  const auto four = run(4);
  CHECK(one.k1 == four.k1);
  CHECK(one.k2 == four.k2);
}

TEST_CASE("fitted quadrics refuse an invalid radius") {
  const TriangleMesh mesh = octahedron().mesh();
  for (const double radius : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    CHECK_THROWS_AS(morse::quadric_curvatures(mesh, radius), core::InvalidArgument);
}
