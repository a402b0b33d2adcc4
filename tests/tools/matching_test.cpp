#include "morsel/tools/study/matching.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using morse::CriticalPoint;
using morse::CriticalPoints;
using morse::CriticalType;
using tools::match_critical_points;
using tools::Matching;

namespace {

/// A path of points at x = 0, 1, 2, … (the lower row of a strip).
TriangleMesh strip() { return grid(12, 2).mesh(); }

CriticalPoints points(std::vector<std::pair<Index, CriticalType>> list) {
  CriticalPoints result;
  for (const auto& [vertex, type] : list) result.points.push_back({vertex, type, 1});
  return result;
}

constexpr auto kMin = CriticalType::minimum;
constexpr auto kMax = CriticalType::maximum;

/// All pairs, sorted; the nearest free one first.
std::size_t moved_by_brute_force(const TriangleMesh& mesh, const CriticalPoints& a, const CriticalPoints& b,
                                 double radius) {
  struct Pair {
    double distance;
    std::size_t i, j;
  };
  std::set<std::size_t> used_a, used_b;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (std::size_t j = 0; j < b.points.size(); ++j) {
      if (a.points[i].type != b.points[j].type) continue;
      if (a.points[i].vertex == b.points[j].vertex) {
        used_a.insert(i);
        used_b.insert(j);
      }
      const double d = (mesh.position(a.points[i].vertex) - mesh.position(b.points[j].vertex)).norm();
      if (d <= radius) pairs.push_back({d, i, j});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.distance, x.i, x.j) < std::tie(y.distance, y.i, y.j);
  });
  std::size_t moved = 0;
  for (const Pair& p : pairs)
    if (!used_a.contains(p.i) && !used_b.contains(p.j)) {
      used_a.insert(p.i);
      used_b.insert(p.j);
      ++moved;
    }
  return moved;
}

}  // namespace

TEST_CASE("a point is kept if the first has the same type at the same vertex") {
  const Matching m =
      match_critical_points(strip(), points({{1, kMin}, {5, kMax}}), points({{1, kMin}, {5, kMin}}), 0);
  CHECK(m.kept.size() == 1);
  CHECK(m.moved.empty());
  CHECK(m.added == 1);
  CHECK(m.removed == 1);
}

TEST_CASE("a point moves to the nearest of its type within the radius inclusive") {
  const CriticalPoints first = points({{2, kMin}, {8, kMax}});
  CHECK(match_critical_points(strip(), first, points({{4, kMin}}), 2).moved.size() == 1);
  CHECK(match_critical_points(strip(), first, points({{4, kMin}}), 1.999).moved.empty());
  CHECK(match_critical_points(strip(), first, points({{7, kMin}}), 2).moved.empty());
}

TEST_CASE("matching is one to one and the nearest pair goes first") {
  const Matching m = match_critical_points(strip(), points({{2, kMin}, {5, kMin}}), points({{4, kMin}}), 3);
  REQUIRE(m.moved.size() == 1);
  CHECK(m.moved[0].reference == 1);
  CHECK(m.removed == 1);
  // 3 is matched with 4, so 2 is matched with 0.
  const Matching chain =
      match_critical_points(strip(), points({{2, kMin}, {3, kMin}}), points({{0, kMin}, {4, kMin}}), 3);
  CHECK(chain.moved.size() == 2);
}

TEST_CASE("matching agrees with brute force on random points") {
  const TriangleMesh mesh = sphere(2).mesh();
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const CriticalPoints a = morse::classify({mesh, random_values(mesh.vertex_count(), random())});
    const CriticalPoints b = morse::classify({mesh, random_values(mesh.vertex_count(), random())});
    for (const double radius : {0.0, 0.35, 0.7, 3.0}) {
      const Matching m = match_critical_points(mesh, a, b, radius);
      CHECK(m.moved.size() == moved_by_brute_force(mesh, a, b, radius));
      CHECK(m.kept.size() + m.moved.size() + m.added == b.points.size());
      CHECK(m.kept.size() + m.moved.size() + m.removed == a.points.size());
      std::set<std::size_t> used;
      for (const auto& match : m.kept) CHECK(used.insert(match.other).second);
      for (const auto& match : m.moved) CHECK(used.insert(match.other).second);
    }
  }
}
