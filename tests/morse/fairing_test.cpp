#include "morsel/morse/operators/fairing.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "morsel/core/error.h"
#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/subdivision.h"
#include "morsel/morse/operators/normals.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using morse::faired;

namespace {

double distance(const TriangleMesh& a, const TriangleMesh& b, Index v) {
  return (a.position(v) - b.position(v)).norm();
}

/// A closed surface with waves of several lengths and nothing else.
TriangleMesh wavy_sphere(int subdivisions) {
  const TriangleMesh mesh = sphere(subdivisions).mesh();
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  for (Point& p : positions)
    p *= 1 + 0.1 * std::sin(3 * p.x() + 1) * std::cos(2 * p.y()) + 0.03 * std::sin(9 * p.z() + 4 * p.x());
  return mesh.with_positions(std::move(positions));
}

/// Each vertex moved along its normal by `deviation` mean edges.
TriangleMesh noisy(const TriangleMesh& mesh, double deviation) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal(0, deviation * core::mean_edge_length(mesh));
  const std::vector<Point> normals = morse::vertex_normals(mesh);
  std::vector<Point> positions(mesh.positions().begin(), mesh.positions().end());
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += normal(engine) * normals[v];
  return mesh.with_positions(std::move(positions));
}

}  // namespace

TEST_CASE("fairing keeps half of a wave of 2 pi times its scale") {
  // A flat sheet, on which heat does nothing but to waves, and to the sheet's rim, which is far off.
  constexpr double kLength = 24;
  const TriangleMesh sheet = grid(97, 41).mesh();
  const auto wave = [](const Point& p) { return std::cos(2 * std::numbers::pi * p.x() / kLength); };
  std::vector<Point> waved(sheet.positions().begin(), sheet.positions().end());
  for (Point& p : waved) p.z() = 1e-3 * wave(p);
  REQUIRE(sheet.bounding_box().max.x() - sheet.bounding_box().min.x() == Approx(4 * kLength));
  for (const double ratio : {0.5, 1.0, 2.0}) {
    const TriangleMesh result = faired(sheet.with_positions(waved), ratio * kLength / (2 * std::numbers::pi));
    double along = 0;
    double total = 0;
    for (Index v = 0; v < sheet.vertex_count(); ++v) {
      const Point& p = sheet.position(v);
      if (std::abs(p.x() - 2 * kLength) > kLength / 2) continue;
      along += wave(p) * result.position(v).z();
      total += wave(p) * wave(p) * 1e-3;
    }
    const double heat = std::pow(1 + (std::sqrt(2 + std::sqrt(2.0)) - 1) * ratio * ratio, -2);  // G
    CHECK(along / total == Approx(heat * (2 - heat)).margin(0.01));
    if (ratio == 1) CHECK(along / total == Approx(0.5).margin(0.01));
  }
}

TEST_CASE("fairing moves, turns and scales with the surface") {
  const TriangleMesh mesh = wavy_sphere(3);
  const TriangleMesh result = faired(mesh, 0.2);
  const TriangleMesh large = faired(scaled(mesh, 8), 1.6);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()).toRotationMatrix();
  const TriangleMesh turned = faired(moved(mesh, turn, Point(3, -1, 2)), 0.2);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(large.position(v) == 8 * result.position(v));
    CHECK((turned.position(v) - (turn * result.position(v) + Point(3, -1, 2))).norm() < 1e-9);
  }
}

TEST_CASE("fairing does not depend on how a surface is sampled") {
  const TriangleMesh mesh = wavy_sphere(4);
  const TriangleMesh finer = core::subdivided(mesh, 2);  // the same surface, the old vertices first
  const TriangleMesh once = faired(mesh, 0.15);
  const TriangleMesh again = faired(finer, 0.15);
  double shift = 0;
  double change = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    shift = std::max(shift, distance(once, again, v));
    change = std::max(change, distance(once, mesh, v));
  }
  CHECK(change > 0.02);
  CHECK(shift < 0.1 * change);
}

TEST_CASE("fairing removes noise and keeps thin parts") {
  const TriangleMesh mesh = sphere(4).mesh();
  const TriangleMesh noise = noisy(mesh, 0.3);
  const TriangleMesh result = faired(noise, 0.15);
  const auto roughness = [](const TriangleMesh& surface) {
    double mean = 0;
    double square = 0;
    for (const Point& p : surface.positions()) {
      mean += p.norm();
      square += p.squaredNorm();
    }
    const double n = surface.vertex_count();
    return std::sqrt(square / n - mean * mean / n / n);
  };
  CHECK(roughness(result) < 0.2 * roughness(noise));
  // The way around a tube of the radius of the scale is a wave of 2 pi times the scale, of which nearly half
  // is left.
  const TriangleMesh tube = cylinder(0.15, 24, 120).mesh();
  const TriangleMesh thin = faired(tube, 0.15);
  const double middle = (tube.bounding_box().max.z() + tube.bounding_box().min.z()) / 2;
  for (Index v = 0; v < tube.vertex_count(); ++v)
    if (std::abs(tube.position(v).z() - middle) < 0.1)
      CHECK(std::hypot(thin.position(v).x(), thin.position(v).y()) > 0.35 * 0.15);
}

TEST_CASE("fairing by nothing changes nothing, and what cannot be faired is refused") {
  const TriangleMesh mesh = wavy_sphere(2);
  const TriangleMesh same = faired(mesh, 0);
  for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(same.position(v) == mesh.position(v));
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    CHECK_THROWS_AS(faired(mesh, bad), core::InvalidArgument);
  CHECK_THROWS_AS(faired(mesh, 5), core::BadInput);
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  CHECK_THROWS_AS(faired(point, 0.1), core::BadInput);
}

TEST_CASE("surfaces of every kind can be faired") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const TriangleMesh result = faired(entry.mesh, 0.3 * core::root_area(entry.mesh));
    for (const Point& p : result.positions()) CHECK(p.allFinite());
    CHECK(result.bounding_box().diagonal() <= 1.5 * entry.mesh.bounding_box().diagonal());
  }
}
