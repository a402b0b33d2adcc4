#include "morsel/morse/functions/discrete_curvature.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "morsel/core/parallel/parallel.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

TEST_CASE("angle defects sum to the Euler characteristic times 2 pi") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const double amount : {0.0, 0.1, 10.0}) {
      INFO(entry.name << ", moved by " << amount);
      const TriangleMesh mesh = jittered(entry.mesh, amount, 3);
      const std::vector<double> defects = morse::angle_defects(mesh);
      CHECK(std::accumulate(defects.begin(), defects.end(), 0.0) ==
            Approx(2 * M_PI * static_cast<double>(mesh.euler_characteristic())).margin(1e-9));
    }
}

TEST_CASE("angle defects sum to the same where triangles have collapsed") {
  const TriangleMesh mesh = sphere(2).mesh();
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  positions[mesh.edge_vertices(0)[0]] = positions[mesh.edge_vertices(0)[1]];
  for (int step = 0; step < 2; ++step) {
    const TriangleMesh collapsed = mesh.with_positions(positions);
    const std::vector<double> defects = morse::angle_defects(collapsed);
    CHECK(std::accumulate(defects.begin(), defects.end(), 0.0) == Approx(4 * M_PI));
    CHECK(std::isfinite(morse::gaussian_curvature(collapsed).extent()));
    CHECK(std::isfinite(morse::cotangent_mean_curvature(collapsed).extent()));
    positions.assign(positions.size(), Point(1, 2, 3));
  }
  CHECK(morse::gaussian_curvature(mesh.with_positions(positions)).extent() == 0);
  CHECK(morse::cotangent_mean_curvature(mesh.with_positions(positions)).extent() == 0);
}

TEST_CASE("curvatures of an octahedron by hand") {
  // Four equilateral triangles of side s = √2 at each vertex: defect 2π − 4π/3, area 8 (√3/4) s² / 6. Moving
  // a vertex outward by 1 changes the area of its triangles by 4 · (s/2) · cos of the angle between triangle
  // and axis, = |K| A / 2 … .
  const TriangleMesh mesh = octahedron().mesh();
  const double area = 8 * std::sqrt(3.0) / 4 * 2 / 6;
  const ScalarField gauss = morse::gaussian_curvature(mesh);
  const ScalarField mean = morse::cotangent_mean_curvature(mesh);
  // Both cotangents at an edge are 1/√3, and the four edges add up to 4 times the way to the middle, 1.
  const double h = 4 * 2 / std::sqrt(3.0) / (2 * area) / 2;
  for (Index v = 0; v < 6; ++v) {
    CHECK(gauss.value(v) == Approx((2 * M_PI - 4 * M_PI / 3) / area));
    CHECK(mean.value(v) == Approx(h));
  }
}

TEST_CASE("discrete curvatures of a sphere come near those of the smooth one") {
  for (const double radius : {0.01, 250.0})
    for (const bool inward : {false, true}) {
      const Soup soup = inward ? inside_out(sphere(4)) : sphere(4);
      const TriangleMesh mesh = scaled(soup.mesh(), radius);
      const ScalarField gauss = morse::gaussian_curvature(mesh);
      const ScalarField mean = morse::cotangent_mean_curvature(mesh);
      CHECK(gauss.min() * radius * radius == Approx(1).epsilon(0.02));
      CHECK(gauss.max() * radius * radius == Approx(1).epsilon(0.02));
      CHECK(mean.min() * radius == Approx(1).epsilon(0.01));
      CHECK(mean.max() * radius == Approx(1).epsilon(0.01));
    }
}

TEST_CASE("discrete curvatures of a plane are zero and those of a cylinder are known") {
  const TriangleMesh plane = grid(9, 8).mesh();
  const ScalarField flat_gauss = morse::gaussian_curvature(plane);
  const ScalarField flat_mean = morse::cotangent_mean_curvature(plane);
  for (Index v = 0; v < plane.vertex_count(); ++v) {
    if (!plane.is_boundary_vertex(v)) CHECK(flat_gauss.value(v) == Approx(0).margin(1e-12));
    CHECK(flat_mean.value(v) == Approx(0).margin(1e-12));
  }
  constexpr int kAround = 60;
  const TriangleMesh tube = cylinder(2.5, kAround, 7).mesh();
  const ScalarField gauss = morse::gaussian_curvature(tube);
  const ScalarField mean = morse::cotangent_mean_curvature(tube);
  for (Index v = 2 * kAround; v < 5 * kAround; ++v) {
    CHECK(gauss.value(v) == Approx(0).margin(1e-10));
    CHECK(mean.value(v) == Approx(0.2).epsilon(2e-3));
  }
}

TEST_CASE("discrete curvatures of a torus") {
  // Radii 2 and 1: k = 1 across, cos b / (2 + cos b) along.
  const TriangleMesh mesh = torus(180, 90).mesh();
  const ScalarField gauss = morse::gaussian_curvature(mesh);
  const ScalarField mean = morse::cotangent_mean_curvature(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double c = std::cos(2 * M_PI * (v % 90) / 90);
    CHECK(gauss.value(v) == Approx(c / (2 + c)).margin(0.02));
    CHECK(mean.value(v) == Approx((1 + c / (2 + c)) / 2).margin(0.02));
  }
}

TEST_CASE("discrete curvatures turn with the mesh and scale exactly by powers of two") {
  const TriangleMesh mesh = jittered(torus(14, 11).mesh(), 0.1, 5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  const TriangleMesh turned = moved(mesh, 3 * turn, Point(7, -4, 2));
  const ScalarField gauss = morse::gaussian_curvature(mesh);
  const ScalarField mean = morse::cotangent_mean_curvature(mesh);
  const ScalarField turned_gauss = morse::gaussian_curvature(turned);
  const ScalarField turned_mean = morse::cotangent_mean_curvature(turned);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(9 * turned_gauss.value(v) == Approx(gauss.value(v)).margin(1e-10));
    CHECK(3 * turned_mean.value(v) == Approx(mean.value(v)).margin(1e-10));
  }
  for (const int exponent : {-400, 7, 400}) {
    const TriangleMesh other = scaled(mesh, std::ldexp(1.0, exponent));
    const ScalarField other_gauss = morse::gaussian_curvature(other);
    const ScalarField other_mean = morse::cotangent_mean_curvature(other);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(other_gauss.value(v) == std::ldexp(gauss.value(v), -2 * exponent));
      CHECK(other_mean.value(v) == std::ldexp(mean.value(v), -exponent));
    }
  }
}

TEST_CASE("discrete curvatures are the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(5).mesh(), 0.01, 4);
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return std::pair(morse::gaussian_curvature(mesh), morse::cotangent_mean_curvature(mesh));
  };
  const auto [gauss, mean] = run(1);
  const auto [gauss4, mean4] = run(4);
  CHECK(std::equal(gauss.values().begin(), gauss.values().end(), gauss4.values().begin()));
  CHECK(std::equal(mean.values().begin(), mean.values().end(), mean4.values().begin()));
}
