#include "morsel/core/mesh/neighbors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::PointSearch;

namespace {

std::vector<Index> found(const PointSearch& search, const Point& center, double radius) {
  std::vector<Index> result = {99, 98};  // must be replaced
  search.within(center, radius, result);
  return result;
}

/// The definition.
std::vector<Index> by_looking(const std::vector<Point>& points, const Point& center, double radius) {
  std::vector<Index> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - center).norm() <= radius) result.push_back(static_cast<Index>(i));
  return result;
}

std::vector<Point> random_points(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Point> points(count);
  for (Point& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(random() >> 11) * 0x1p-53;
  return points;
}

}  // namespace

TEST_CASE("a neighbourhood includes its own border") {
  const std::vector<Point> points = {{5, 0, 0}, {0, 0, 0}, {3, 4, 0}, {0, 0, 5.000000000000001}, {0, -5, 0}};
  const PointSearch search(points);
  CHECK(found(search, {0, 0, 0}, 5) == std::vector<Index>{0, 1, 2, 4});
  CHECK(found(search, {0, 0, 0}, std::nextafter(5.0, 0.0)) == std::vector<Index>{1});
  CHECK(found(search, {0, 0, 0}, 0) == std::vector<Index>{1});
  CHECK(found(search, {0, 0, 0}, -1).empty());
  CHECK(found(search, {0, 0, 0}, std::numeric_limits<double>::quiet_NaN()).empty());
  CHECK(found(search, {0, 0, 0}, std::numeric_limits<double>::infinity()).size() == 5);
}

TEST_CASE("a neighbourhood on a lattice has its border exactly") {
  // Hundreds of points lie at exactly the radius, where a comparison of squares with 0.3² would differ.
  std::vector<Point> points;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 12; ++z) points.emplace_back(0.1 * x, 0.1 * y, 0.1 * z);
  const PointSearch search(points);
  for (const double radius : {0.1, 0.3, 0.5, 0.7})
    for (std::size_t i = 0; i < points.size(); i += 37)
      CHECK(found(search, points[i], radius) == by_looking(points, points[i], radius));
}

TEST_CASE("neighbourhoods agree with brute force at every scale") {
  const std::vector<Point> points = random_points(500, 3);
  for (const double scale : {1.0, 1e-160, 1e-300, 1e150, 1e300}) {
    std::vector<Point> scaled = points;
    for (Point& p : scaled) p *= std::exp2(std::round(std::log2(scale)));
    const double unit = std::exp2(std::round(std::log2(scale)));
    const PointSearch search(scaled);
    for (const double radius : {0.0, 0.05, 0.2, 2.0})
      for (std::size_t i = 0; i < points.size(); i += 41)
        CHECK(found(search, scaled[i], radius * unit) == by_looking(points, points[i], radius));
  }
}

TEST_CASE("coinciding points and small sets are searched") {
  const std::vector<Point> same(1000, Point(1, 2, 3));
  CHECK(found(PointSearch(same), {1, 2, 3}, 0).size() == 1000);
  CHECK(found(PointSearch(std::vector<Point>(50, Point::Zero())), {0, 0, 0}, 0).size() == 50);
  CHECK(found(PointSearch({}), {0, 0, 0}, 1).empty());
  CHECK(found(PointSearch(std::vector<Point>{{1, 1, 1}}), {0, 0, 0}, 2) == std::vector<Index>{0});
}

TEST_CASE("the reach of the nearest points is the distance of the last of them") {
  std::vector<Point> points = random_points(400, 5);
  points.insert(points.end(), 30, points[7]);
  for (const double unit : {1.0, 0x1p-900, 0x1p500}) {
    std::vector<Point> scaled = points;
    for (Point& p : scaled) p *= unit;
    const PointSearch search(scaled);
    for (std::size_t i = 0; i < points.size(); i += 7) {
      std::vector<double> distances;
      for (const Point& p : points) distances.push_back((p - points[i]).norm());
      std::sort(distances.begin(), distances.end());
      for (const std::size_t count : {1u, 2u, 31u, 100u, 430u})
        CHECK(search.reach(scaled[i], count) == distances[count - 1] * unit);
    }
    CHECK(search.reach(scaled[0], 431) == std::numeric_limits<double>::infinity());
    CHECK_THROWS_AS(search.reach(scaled[0], 0), core::InvalidArgument);
  }
}

TEST_CASE("a point search refuses points that are not finite") {
  CHECK_THROWS_AS(PointSearch(std::vector<Point>{{0, 0, 0}, {0, INFINITY, 0}}), core::InvalidArgument);
}

TEST_CASE("a point search may be used by many threads") {
  const core::ThreadLimit limit(4);
  const std::vector<Point> points = random_points(5000, 5);
  const PointSearch search(points);
  std::vector<std::vector<Index>> results(points.size());
  core::parallel_for(0, points.size(), 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) search.within(points[i], 0.1, results[i]);
  });
  for (std::size_t i = 0; i < points.size(); i += 97) CHECK(results[i] == by_looking(points, points[i], 0.1));
}
