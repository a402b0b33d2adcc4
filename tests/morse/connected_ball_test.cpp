#include "morsel/morse/operators/connected_ball.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;

namespace {

/// Grows the ball one edge at a time until nothing changes.
std::set<Index> slow_ball(const TriangleMesh& mesh, Index v, double radius) {
  std::set<Index> ball = {v};
  for (bool grown = true; grown;) {
    grown = false;
    for (const core::Triangle& t : mesh.triangles())
      for (const Index a : t)
        for (const Index b : t)
          if (ball.count(a) > 0 && (mesh.position(b) - mesh.position(v)).norm() <= radius)
            grown |= ball.insert(b).second;
  }
  return ball;
}

}  // namespace

TEST_CASE("connected balls agree with growing them edge by edge") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    if (entry.mesh.vertex_count() > 400) continue;
    const TriangleMesh mesh = jittered(entry.mesh, 0.02, 3);
    const morse::ConnectedBalls balls(mesh);
    morse::ConnectedBalls::Walk walk(balls);
    std::vector<Index> found;
    for (const double share : {0.0, 0.1, 0.3, 2.0})
      for (Index v = 0; v < mesh.vertex_count(); v += 7) {
        const double radius = share * mesh.bounding_box().diagonal();
        walk.within(v, radius, found);
        CHECK(found.front() == v);
        const std::set<Index> expected = slow_ball(mesh, v, radius);
        CHECK(found.size() == expected.size());
        CHECK(std::set<Index>(found.begin(), found.end()) == expected);
      }
  }
}

TEST_CASE("a connected ball takes what is exactly at its radius whatever the unit") {
  Soup soup = square_pair();
  for (const double unit : {1.0, 0x1p-1000, 0x1p500}) {
    const TriangleMesh mesh = scaled(soup.mesh(), unit);
    const morse::ConnectedBalls balls(mesh);
    morse::ConnectedBalls::Walk walk(balls);
    std::vector<Index> found;
    const double side = (mesh.position(1) / unit - mesh.position(0) / unit).norm() * unit;
    walk.within(0, side, found);
    CHECK(std::count(found.begin(), found.end(), 1) == 1);
    walk.within(0, side * (1 - 1e-15), found);
    CHECK(std::count(found.begin(), found.end(), 1) == 0);
  }
}

TEST_CASE("widening adds whole rings and ends with the component") {
  const TriangleMesh mesh = together(sphere(2), octahedron()).mesh();
  const morse::ConnectedBalls balls(mesh);
  morse::ConnectedBalls::Walk walk(balls);
  std::vector<Index> found;
  std::vector<Index> ring;
  walk.within(50, 0, found);
  walk.widen(2, found);
  mesh.neighbors(50, ring);
  CHECK(found.size() == ring.size() + 1);
  walk.within(50, 0, found);
  walk.widen(8, found);
  CHECK(found.size() > 12);
  walk.within(0, 0, found);
  walk.widen(100000, found);
  CHECK(found.size() == 162);
  std::sort(found.begin(), found.end());
  CHECK(std::unique(found.begin(), found.end()) == found.end());
}
