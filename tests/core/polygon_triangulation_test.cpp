#include "morsel/core/mesh/polygon_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "morsel/core/mesh/mesh_builder.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::PolygonSoup;
using core::Triangle;

namespace {

/// One polygon over all positions in their order.
PolygonSoup one_polygon(std::vector<Point> positions) {
  PolygonSoup soup;
  std::vector<Index> corners(positions.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  soup.positions = std::move(positions);
  soup.add_polygon(corners);
  return soup;
}

double signed_area(std::span<const Point> p, const Triangle& t) {
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z();
}

/// Cuts a flat polygon and checks that the triangles are turned the same way and fill it exactly.
std::vector<Triangle> check_flat(const std::vector<Point>& polygon) {
  const core::TriangleMesh mesh = core::build_mesh(one_polygon(polygon)).mesh;
  mesh.validate();
  CHECK(mesh.triangle_count() == polygon.size() - 2);
  CHECK(mesh.euler_characteristic() == 1);
  double area = 0;
  for (const Triangle& t : mesh.triangles()) {
    CHECK(signed_area(polygon, t) >= 0);
    area += signed_area(polygon, t);
  }
  double expected = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    expected += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  CHECK(area == Approx(expected).epsilon(1e-12));
  return {mesh.triangles().begin(), mesh.triangles().end()};
}

std::vector<Point> star(int points, double inner) {
  std::vector<Point> result;
  for (int i = 0; i < 2 * points; ++i) {
    const double a = std::numbers::pi * i / points;
    const double r = i % 2 == 0 ? 1 : inner;
    result.emplace_back(r * std::cos(a), r * std::sin(a), 0);
  }
  return result;
}

}  // namespace

TEST_CASE("a quad is cut along its better diagonal") {
  using Cut = std::vector<Triangle>;
  const Cut ac = {{0, 1, 2}, {0, 2, 3}}, bd = {{1, 2, 3}, {1, 3, 0}};
  CHECK(check_flat({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == ac);   // a square: the first corner's
  CHECK(check_flat({{0, 0, 0}, {2, -1, 0}, {4, 0, 0}, {2, 1, 0}}) == bd);  // the shorter one of a rhombus
  CHECK(check_flat({{0, 0, 0}, {2, 1, 0}, {0, 4, 0}, {-2, 1, 0}}) == ac);  // a kite
  CHECK(check_flat({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}) == ac);   // an arrow, bent in at 2
  CHECK(check_flat({{4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {0, 0, 0}}) == bd);   // the same from its next corner
  CHECK(check_flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}}) == bd);  // a triangle with a point on a side
}

TEST_CASE("a grid of squares has all its diagonals the same way wherever it lies") {
  // Rounding must not choose between diagonals of equal length.
  PolygonSoup soup;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) soup.positions.emplace_back(0.1 * x + 1e3, 0.1 * y - 7, 0.3);
  for (Index y = 0; y < 8; ++y)
    for (Index x = 0; x < 8; ++x) {
      const Index v = 9 * y + x;
      soup.add_polygon(std::array<Index, 4>{v, v + 1, v + 10, v + 9});
    }
  const core::TriangleMesh mesh = core::build_mesh(soup).mesh;
  for (Index t = 0; t < mesh.triangle_count(); t += 2) CHECK(mesh.triangle(t)[2] == mesh.triangle(t)[0] + 10);
}

TEST_CASE("flat polygons are filled exactly") {
  check_flat({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}, {2, 4, 0}, {1, 1, 0}, {0, 4, 0}});
  check_flat(star(5, 0.4));
  check_flat(star(30, 0.9));
  check_flat(star(100, 0.5));  // above the size up to which the best ear is looked for
  check_flat(star(1000, 0.99));
  // Points in the middle of sides, as at T-junctions.
  check_flat(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 2, 0}, {3, 3, 0}, {0, 3, 0}, {0, 1, 0}});
  // A spiral.
  std::vector<Point> outer, inner;
  for (int i = 0; i <= 60; ++i) {
    const double a = 0.2 * i;
    outer.emplace_back((2 + 0.2 * a) * std::cos(a), (2 + 0.2 * a) * std::sin(a), 0);
    inner.emplace_back((1.5 + 0.2 * a) * std::cos(a), (1.5 + 0.2 * a) * std::sin(a), 0);
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  check_flat(outer);
}

TEST_CASE("random star-shaped polygons are filled exactly at any scale and place") {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    const int n = 5 + static_cast<int>(random() % 40);
    std::vector<Point> polygon;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      const double r = 1 + static_cast<double>(random() % 1000) / 200;
      polygon.emplace_back(r * std::cos(a), r * std::sin(a), 0);
    }
    check_flat(polygon);
    const core::TriangleMesh mesh = core::build_mesh(one_polygon(polygon)).mesh;
    for (Point& p : polygon) p *= 0x1p500;  // squares overflow
    const core::TriangleMesh large = core::build_mesh(one_polygon(polygon)).mesh;
    CHECK(std::equal(mesh.triangles().begin(), mesh.triangles().end(), large.triangles().begin()));
  }
}

TEST_CASE("polygons in any plane and bent ones are cut into n minus 2 triangles") {
  std::mt19937 random(13);
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 4 + random() % 12;
    std::vector<Point> polygon;
    for (std::size_t i = 0; i < n; ++i)
      polygon.push_back(Point(random() % 9, random() % 9, random() % 9) / 8);
    const core::TriangleMesh mesh = core::build_mesh(one_polygon(polygon)).mesh;
    mesh.validate();
    CHECK(mesh.triangle_count() == n - 2);
    CHECK(mesh.boundary_loop(0).size() == n);
  }
}

TEST_CASE("polygons without an area are cut somehow") {
  const core::TriangleMesh line =
      core::build_mesh(one_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}})).mesh;
  CHECK(line.triangle_count() == 3);
  CHECK(core::build_mesh(one_polygon(std::vector<Point>(6, Point(1, 1, 1)))).mesh.triangle_count() == 4);
}

TEST_CASE("a diagonal is not laid where the mesh has an edge") {
  // The cube, coarse: each quad's corners are joined by no other edge. A hexagonal pillow: both faces would
  // take the same diagonals.
  PolygonSoup soup;
  for (int i = 0; i < 6; ++i)
    soup.positions.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0);
  soup.positions.emplace_back(0, 0, 1);
  soup.add_polygon(std::array<Index, 6>{5, 4, 3, 2, 1, 0});
  // Three quads that meet in the apex and use the diagonals 0-2, 2-4, 4-0 of the hexagon as edges.
  for (const auto& t :
       std::vector<Triangle>{{0, 1, 2}, {2, 3, 4}, {4, 5, 0}, {0, 2, 6}, {2, 4, 6}, {4, 0, 6}})
    soup.add_polygon(t);
  const core::TriangleMesh mesh = core::build_mesh(soup).mesh;
  mesh.validate();
  CHECK(mesh.is_closed());
  CHECK(mesh.euler_characteristic() == 2);
}

TEST_CASE("small closed quad meshes stay manifold") {
  // A torus of 3 × 3 and of 3 × 4 quads, where careless diagonals coincide.
  for (const Index along : {3u, 4u, 5u}) {
    const Soup base = torus(3, static_cast<int>(along));
    PolygonSoup soup;
    soup.positions = base.positions;
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < along; ++j) {
        const Index i1 = (i + 1) % 3, j1 = (j + 1) % along;
        soup.add_polygon(
            std::array<Index, 4>{i * along + j, i1 * along + j, i1 * along + j1, i * along + j1});
      }
    CHECK(core::build_mesh(soup).mesh.genus() == 1);
  }
}

TEST_CASE("an edge set knows its edges either way round") {
  core::EdgeSet edges;
  std::mt19937 random(17);
  std::set<std::pair<Index, Index>> expected;
  for (int i = 0; i < 5000; ++i) {
    const auto a = static_cast<Index>(random() % 200), b = static_cast<Index>(random() % 200);
    edges.insert(a, b);
    expected.insert(std::minmax(a, b));
  }
  for (Index a = 0; a < 200; ++a)
    for (Index b = 0; b < 200; ++b) CHECK(edges.contains(a, b) == expected.contains(std::minmax(a, b)));
}
