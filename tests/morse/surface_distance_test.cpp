#include "morsel/morse/operators/surface_distance.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/path_oracle.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using morse::SurfaceDistances;

namespace {

std::vector<double> distances_from(const TriangleMesh& mesh, Index v, double radius) {
  const SurfaceDistances distances(mesh);
  SurfaceDistances::Search search(distances);
  std::vector<double> result(mesh.vertex_count(), HUGE_VAL);
  double last = 0;
  for (const auto& [u, d] : search.within(v, radius)) {
    CHECK(d >= last);  // nearest first
    last = d;
    result[u] = d;
  }
  return result;
}

}  // namespace

TEST_CASE("surface distances run along edges and straight across two triangles") {
  // From one tip of an octahedron to the other two triangles unfold to a rhombus.
  const std::vector<double> tip = distances_from(octahedron().mesh(), 0, 10);
  CHECK(tip[0] == 0);
  CHECK(tip[1] == Approx(std::sqrt(6.0)));
  for (const Index v : {2, 3, 4, 5}) CHECK(tip[v] == Approx(std::sqrt(2.0)));
  const std::vector<double> flat = distances_from(square_pair().mesh(), 0, 10);
  for (Index v = 0; v < 4; ++v)  // both diagonals
    CHECK(flat[v] == Approx((square_pair().positions[v] - square_pair().positions[0]).norm()));
}

TEST_CASE("surface distances agree with all pairs by brute force") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const TriangleMesh mesh = random_surface(seed);
    const auto expected = all_distances(mesh);
    const SurfaceDistances distances(mesh);
    SurfaceDistances::Search search(distances);
    const double radius = 0.317 * mesh.bounding_box().diagonal();
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      for (const double reach : {radius, 1e9}) {
        std::vector<double> found(mesh.vertex_count(), HUGE_VAL);
        for (const auto& [u, d] : search.within(v, reach)) found[u] = d;
        for (Index u = 0; u < mesh.vertex_count(); ++u) {
          const bool within = expected[v][u] < reach;
          CHECK(std::isfinite(found[u]) == within);
          if (within) CHECK(found[u] == Approx(expected[v][u]).margin(1e-12));
        }
      }
    std::vector<Index> some;
    for (Index v = 0; v < mesh.vertex_count(); v += 3) some.push_back(v);
    const std::vector<double> nearest = distances.to_nearest_other(some);
    for (std::size_t i = 0; i < some.size(); ++i) {
      double least = HUGE_VAL;
      for (const Index u : some)
        if (u != some[i]) least = std::min(least, expected[some[i]][u]);
      CHECK(nearest[i] == (std::isinf(least) ? Approx(least) : Approx(least).margin(1e-12)));
    }
  }
}

TEST_CASE(
    "surface distances are never shorter than geodesic ones, and at most 3.6 % longer on even triangles") {
  // A cylinder of equilateral triangles unrolls to a strip.
  constexpr int kAround = 40;
  constexpr int kRows = 30;
  const double radius = 2;
  const TriangleMesh tube = cylinder(radius, kAround, kRows).mesh();
  const Index start = kAround * (kRows / 2);
  const std::vector<double> found = distances_from(tube, start, 3);
  // Its rows are straight: the surface lies a little inside the round cylinder.
  const double chord = 2 * radius * std::sin(std::numbers::pi / kAround);
  const double unrolled = chord * kAround / (2 * std::numbers::pi);
  std::size_t checked = 0;
  for (Index v = 0; v < tube.vertex_count(); ++v) {
    if (!std::isfinite(found[v]) || v == start) continue;
    const Point a = tube.position(start);
    const Point b = tube.position(v);
    double turn = std::abs(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()));
    turn = std::min(turn, 2 * std::numbers::pi - turn);
    const double exact = std::hypot(turn * unrolled, b.z() - a.z());
    CHECK(found[v] > exact * 0.99);
    CHECK(found[v] < exact * 1.045);  // triangles of the strip are not quite in one plane
    ++checked;
  }
  CHECK(checked > 250);
}

TEST_CASE("surface distances scale exactly and end at components") {
  const TriangleMesh mesh = together(sphere(2), torus(9, 7)).mesh();
  const std::vector<double> found = distances_from(mesh, 3, 1.5);
  for (const int exponent : {-500, 60}) {
    const std::vector<double> other =
        distances_from(scaled(mesh, std::ldexp(1, exponent)), 3, std::ldexp(1.5, exponent));
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(std::ldexp(other[v], -exponent) == found[v]);
  }
  const std::vector<double> all = distances_from(mesh, 3, 1e6);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(std::isfinite(all[v]) == (mesh.component_of_vertex(v) == mesh.component_of_vertex(3)));
  CHECK(distances_from(mesh, 3, 0)[3] == HUGE_VAL);  // nearer than nothing is nothing
}

TEST_CASE("farthest points agree with brute force") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const TriangleMesh mesh = random_surface(seed);
    const auto distance = all_distances(mesh);
    const Index start = seed % mesh.vertex_count();
    // Distances are sums in another order than Dijkstra's: the last digits do not decide.
    const auto is_farther = [](double a, double b) { return a > b * (1 + 1e-9); };
    const std::vector<Index> chosen = SurfaceDistances(mesh).farthest_points(start, 8);
    REQUIRE(chosen.size() == std::min<std::size_t>(8, mesh.vertex_count()));
    std::vector<double> nearest(mesh.vertex_count(), HUGE_VAL);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (i > 0) CHECK_FALSE(is_farther(nearest[v], nearest[chosen[i]]));
        if (i == 0 && std::isfinite(distance[start][v]))
          CHECK_FALSE(is_farther(distance[start][v], distance[start][chosen[0]]));
      }
      CHECK(nearest[chosen[i]] > 0);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        nearest[v] = std::min(nearest[v], distance[chosen[i]][v]);
    }
  }
}

TEST_CASE("farthest points of a strip are its ends, then the middles") {
  const SurfaceDistances strip(grid(9, 2).mesh());
  CHECK(strip.farthest_points(3, 2) == std::vector<Index>{17, 0});
  CHECK(strip.farthest_points(3, 0).empty());
  CHECK(strip.farthest_points(0, 100).size() == 18);
  const SurfaceDistances two(together(octahedron(), octahedron()).mesh());
  const std::vector<Index> chosen = two.farthest_points(0, 2);
  CHECK(chosen == std::vector<Index>{1, 6});  // each component has one before any has two
}

TEST_CASE("vertices that are taken lie apart") {
  const SurfaceDistances strip(grid(9, 2).mesh());
  morse::SpacedVertices apart(strip, 2);
  CHECK(apart.take(4));
  CHECK_FALSE(apart.take(4));
  CHECK_FALSE(apart.take(5));
  CHECK(apart.take(6));  // at the distance itself
  morse::SpacedVertices any(strip, 0);
  for (Index v = 0; v < 18; ++v) CHECK(any.take(v));
  for (Index v = 0; v < 18; ++v) CHECK_FALSE(any.take(v));
}
