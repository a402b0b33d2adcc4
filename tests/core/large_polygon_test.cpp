#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stop_token>

#include "morsel/core/error.h"
#include "morsel/core/mesh/corner_tree.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/mesh/polygon_triangulation.h"
#include "morsel/core/parallel/index_set.h"
#include "support/adversarial.h"

using namespace morsel;
using namespace morsel::test;
using core::EdgeSet;
using core::PolygonTriangulator;
using core::Triangle;
using Polygon = std::vector<Point>;

namespace {

double turn(const Point& a, const Point& b, const Point& c) { return (b - a).cross(c - a).z(); }

/// The next ear in turn, looked for at every corner against all reflex ones.
std::vector<Triangle> cut_slowly(const Polygon& p) {
  std::vector<Index> ring(p.size());
  std::iota(ring.begin(), ring.end(), Index{0});
  std::vector<Triangle> triangles;
  std::size_t start = 0;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    const auto before = [&](std::size_t i) { return ring[i == 0 ? n - 1 : i - 1]; };
    const auto after = [&](std::size_t i) { return ring[i == n - 1 ? 0 : i + 1]; };
    std::vector<Index> reflex;
    for (std::size_t i = 0; i < n; ++i)
      if (!(turn(p[before(i)], p[ring[i]], p[after(i)]) > 0)) reflex.push_back(ring[i]);
    const auto is_ear = [&](std::size_t b) {
      const Point &A = p[before(b)], &B = p[ring[b]], &C = p[after(b)];
      return turn(A, B, C) > 0 && std::none_of(reflex.begin(), reflex.end(), [&](Index i) {
               const Point& q = p[i];
               return q != A && q != B && q != C && turn(A, B, q) > 0 && turn(B, C, q) > 0 &&
                      turn(C, A, q) >= 0;
             });
    };
    std::size_t b = start;
    while (!is_ear(b)) {
      b = b == n - 1 ? 0 : b + 1;
      if (b == start) return {};
    }
    triangles.push_back({before(b), ring[b], after(b)});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(b));
    start = b + 1 < n - 1 ? b + 1 : b + 2 - n;  // the corner after the next one
  }
  triangles.push_back({ring[start], ring[(start + 1) % 3], ring[(start + 2) % 3]});
  return triangles;
}

struct Cut {
  std::vector<Triangle> triangles;
  EdgeSet edges;
};

/// A polygon over all positions.
void cut(const Polygon& polygon, Cut& result, PolygonTriangulator::Limits limits = {},
         const core::Progress& progress = {}) {
  std::vector<Index> corners(polygon.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  for (std::size_t i = 0; i < corners.size(); ++i)
    result.edges.insert(corners[i], corners[(i + 1) % corners.size()]);
  PolygonTriangulator(polygon, result.edges, progress, limits).triangulate(corners, 17, result.triangles);
}

double area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  return sum;
}

/// n − 2 triangles of the polygon's orientation that fill it; a mesh, so that no edge is used twice.
void check_filled(const Polygon& polygon, const std::vector<Triangle>& triangles) {
  REQUIRE(triangles.size() == polygon.size() - 2);
  const double whole = area(polygon);
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double here = 0.5 * turn(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    if (here < -1e-12 * whole) FAIL("a triangle is turned round");
    sum += here;
  }
  CHECK(sum == Approx(whole).epsilon(1e-9));
  CHECK(core::TriangleMesh(polygon, triangles).euler_characteristic() == 1);
}

constexpr PolygonTriangulator::Limits kFewTests = {0, 250};  // for each corner

}  // namespace

TEST_CASE("a large polygon is clipped at the next ear in turn") {
  std::mt19937 random(5);
  for (const auto& [name, make] : adversarial::simple_polygons()) {
    CAPTURE(name);
    for (const std::size_t size : {100u, 220u}) {
      const Polygon polygon = make(size);
      Cut fast;
      cut(polygon, fast);
      CHECK(fast.triangles == cut_slowly(polygon));
      check_filled(polygon, fast.triangles);
    }
  }
  for (int round = 0; round < 20; ++round) {
    const Polygon polygon = adversarial::maze(100 + random() % 200, random());
    Cut fast;
    cut(polygon, fast);
    CHECK(fast.triangles == cut_slowly(polygon));
  }
}

TEST_CASE("a polygon of 40,000 corners takes some tens of tests a corner") {
  for (const auto& [name, make] : adversarial::simple_polygons()) {
    CAPTURE(name);
    const Polygon polygon = make(40'000);
    Cut result;
    cut(polygon, result, kFewTests);
    check_filled(polygon, result.triangles);
  }
}

TEST_CASE("a polygon of 30,000 corners that has no area, touches or crosses itself is cut as fast") {
  const Index n = 30'000;
  std::mt19937 random(3);
  Polygon line, spread, bent;
  for (Index i = 0; i < n; ++i) {
    line.emplace_back(i, 0, 0);
    spread.emplace_back(random() % 1000, random() % 1000, 0);
    bent.emplace_back(std::cos(1e-3 * i), std::sin(1e-3 * i), random() % 9);
  }
  for (const Polygon& polygon : {line, Polygon(n, Point(1, 1, 1)), spread, bent}) {
    Cut result;
    cut(polygon, result, {0, 5000});
    const core::TriangleMesh mesh(polygon, result.triangles);
    CHECK(mesh.triangle_count() == n - 2);
    CHECK(mesh.euler_characteristic() == 1);
    CHECK(mesh.boundary_loop(0).size() == n);
  }
  // Petals that meet in one place, at vertices of their own.
  Polygon flower;
  for (Index i = 0; i < n / 3; ++i) {
    flower.emplace_back(0, 0, 0);
    for (const double a : {0.0, 0.5}) {
      const double angle = 2 * std::numbers::pi * (i + a) / (n / 3.);
      flower.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
  }
  Cut result;
  cut(flower, result, kFewTests);
  check_filled(flower, result.triangles);
}

TEST_CASE("a large polygon with corners within its straight sides is filled") {
  for (const Index side : {30u, 1000u}) {
    const Polygon corners = {{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}};
    Polygon polygon;
    for (int s = 0; s < 3; ++s)
      for (Index i = 0; i < side; ++i) {
        const double f = static_cast<double>(i) / side;
        polygon.emplace_back(corners[s] * (1 - f) + corners[(s + 1) % 3] * f);
      }
    Cut result;
    cut(polygon, result, {0, 2000});
    check_filled(polygon, result.triangles);
  }
}

TEST_CASE("a large polygon avoids diagonals that the mesh has as edges") {
  const Polygon polygon = adversarial::simple_polygons().front().make(200);
  Cut without, with;
  cut(polygon, without);
  for (std::size_t t = 0; t < without.triangles.size(); t += 9)
    with.edges.insert(without.triangles[t][0], without.triangles[t][2]);
  cut(polygon, with);
  CHECK(core::TriangleMesh(polygon, with.triangles).euler_characteristic() == 1);
  for (std::size_t t = 0; t < without.triangles.size(); t += 9)
    CHECK(std::none_of(with.triangles.begin(), with.triangles.end(), [&](const Triangle& other) {
      return other[0] == without.triangles[t][0] && other[2] == without.triangles[t][2];
    }));
}

TEST_CASE("a polygon too intricate to be cut in time is refused") {
  Cut result;
  CHECK_THROWS_WITH(cut(adversarial::comb(6002), result, {1000, 1}),
                    "face 17 is a polygon of 6002 corners, too intricate to be cut into triangles");
}

TEST_CASE("the cutting of a large polygon can be cancelled") {
  std::stop_source stop;
  stop.request_stop();
  Cut result;
  CHECK_THROWS_AS(cut(adversarial::comb(6002), result, {}, core::Progress({}, stop.get_token())),
                  core::Cancelled);
}

TEST_CASE("a tree of corners agrees with testing all corners, after any removals") {
  std::mt19937 random(7);
  const auto coordinate = [&](int range) { return static_cast<double>(random() % range) / range; };
  for (const int range : {7, 1000}) {  // many corners at one place, and few
    Polygon polygon;
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < 300; ++i) {
      polygon.emplace_back(coordinate(range), coordinate(range), 0);
      if (i % 3 != 0) corners.push_back(i);
    }
    core::CornerTree tree(polygon, Point(0, 0, 1), corners);
    while (!corners.empty()) {
      for (int round = 0; round < 20; ++round) {
        const std::size_t a = random() % 300, b = random() % 300, c = random() % 300;
        const Point &A = polygon[a], &B = polygon[b], &C = polygon[c];
        if (!(turn(A, B, C) > 0)) continue;
        const bool expected = std::any_of(corners.begin(), corners.end(), [&](std::size_t i) {
          const Point& q = polygon[i];
          return q != A && q != B && q != C && turn(A, B, q) > 0 && turn(B, C, q) > 0 && turn(C, A, q) >= 0;
        });
        std::uint64_t tests = 0;
        CHECK(tree.any_in(a, b, c, tests) == expected);
      }
      const std::size_t k = random() % corners.size();
      tree.remove(corners[k]);
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
    }
    std::uint64_t tests = 0;
    CHECK_FALSE(tree.any_in(0, 1, 2, tests));
  }
}

TEST_CASE("an index set knows the next number") {
  std::mt19937 random(9);
  for (const std::size_t bound : {1u, 64u, 65u, 5000u, 300'000u}) {
    core::IndexSet set(bound);
    std::set<std::size_t> expected;
    for (int i = 0; i < 2000; ++i) {
      const std::size_t k = random() % bound;
      if (random() % 2 == 0) {
        set.insert(k);
        expected.insert(k);
      } else {
        set.erase(k);
        expected.erase(k);
      }
      const std::size_t from = random() % bound;
      const auto next = expected.lower_bound(from);
      REQUIRE(set.next(from) == (next == expected.end() ? core::IndexSet::kNone : *next));
      REQUIRE(set.contains(from) == expected.contains(from));
    }
  }
}
