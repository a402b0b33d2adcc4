#include "morsel/tools/study/point_matching.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <random>
#include <set>

#include "morsel/core/error.h"

using namespace morsel;
using core::Point;
using tools::PointMatcher;
using tools::PointPair;

namespace {

std::vector<Point> on_line(std::initializer_list<double> places) {
  std::vector<Point> points;
  for (const double x : places) points.emplace_back(x, 0, 0);
  return points;
}

std::vector<Point> random_points(std::size_t count, std::mt19937& random) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(random() % 1000 / 1000.0, random() % 1000 / 1000.0, 0);
  return points;
}

double total(const std::vector<PointPair>& pairs) {
  double sum = 0;
  for (const PointPair& pair : pairs) sum += pair.distance;
  return sum;
}

/// The best of all ways to match: most pairs, then the least sum of distances.
std::pair<std::size_t, double> best_of_all(const std::vector<Point>& reference,
                                           const std::vector<Point>& other, double radius) {
  std::pair<std::size_t, double> best{0, 0};
  std::vector<bool> taken(reference.size(), false);
  const std::function<void(std::size_t, std::size_t, double)> go = [&](std::size_t j, std::size_t pairs,
                                                                       double sum) {
    if (j == other.size()) {
      if (pairs > best.first || (pairs == best.first && sum < best.second)) best = {pairs, sum};
      return;
    }
    go(j + 1, pairs, sum);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double distance = (reference[i] - other[j]).norm();
      if (taken[i] || distance > radius) continue;
      taken[i] = true;
      go(j + 1, pairs + 1, sum + distance);
      taken[i] = false;
    }
  };
  go(0, 0, 0);
  return best;
}

void check_pairs(const std::vector<PointPair>& pairs, const std::vector<Point>& reference,
                 const std::vector<Point>& other, double radius) {
  std::set<std::size_t> references, others;
  for (const PointPair& pair : pairs) {
    CHECK(references.insert(pair.reference).second);
    CHECK(others.insert(pair.other).second);
    CHECK(pair.distance == (reference[pair.reference] - other[pair.other]).norm());
    CHECK(pair.distance <= radius);
  }
}

}  // namespace

TEST_CASE("more pairs are better than near ones") {
  // The nearest pair, 1 with 0.6, would leave 0 and 1.9 alone.
  const auto reference = on_line({0, 1});
  const auto pairs = PointMatcher(reference, 1).match(on_line({0.6, 1.9})).pairs;
  REQUIRE(pairs.size() == 2);
  CHECK((pairs[0].reference == 0 && pairs[0].other == 0));
  CHECK((pairs[1].reference == 1 && pairs[1].other == 1));
  CHECK(total(pairs) == Approx(1.5));
}

TEST_CASE("among as many pairs the nearest are taken") {
  const auto pairs = PointMatcher(on_line({0, 10}), 20).match(on_line({9, 2})).pairs;
  REQUIRE(pairs.size() == 2);
  CHECK(total(pairs) == Approx(3));
  const auto one = PointMatcher(on_line({5}), 20).match(on_line({9, 6, 2})).pairs;
  REQUIRE(one.size() == 1);
  CHECK(one[0].other == 1);
}

TEST_CASE("the radius is inclusive, and one of 0 matches what is at the same place") {
  CHECK(PointMatcher(on_line({0}), 2).match(on_line({2})).pairs.size() == 1);
  CHECK(PointMatcher(on_line({0}), 1.999).match(on_line({2})).pairs.empty());
  const auto pairs = PointMatcher(on_line({0, 1, 2}), 0).match(on_line({2, 0.5, 0})).pairs;
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].reference == 2);
  CHECK(pairs[1].reference == 0);
  CHECK_THROWS_AS(PointMatcher(on_line({0}), -1), core::InvalidArgument);
  CHECK(PointMatcher({}, 1).match(on_line({0})).pairs.empty());
  CHECK(PointMatcher(on_line({0}), 1).match({}).pairs.empty());
}

TEST_CASE("matching agrees with brute force") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 400; ++trial) {
    const auto reference = random_points(random() % 7, random);
    const auto other = random_points(random() % 7, random);
    for (const double radius : {0.2, 0.4, 0.8, 2.0}) {
      const auto pairs = PointMatcher(reference, radius).match(other).pairs;
      check_pairs(pairs, reference, other, radius);
      const auto [count, sum] = best_of_all(reference, other, radius);
      CHECK(pairs.size() == count);
      CHECK(PointMatcher(reference, radius).count(other) == count);
      CHECK(total(pairs) == Approx(sum).margin(1e-7));
    }
  }
}

TEST_CASE("matching of many points is as good either way round and never fewer than the nearest first") {
  std::mt19937 random(4);
  for (const double radius : {0.02, 0.06, 0.2}) {
    const auto reference = random_points(400, random);
    const auto other = random_points(300, random);
    const auto pairs = PointMatcher(reference, radius).match(other).pairs;
    const auto reverse = PointMatcher(other, radius).match(reference).pairs;
    check_pairs(pairs, reference, other, radius);
    CHECK(pairs.size() == reverse.size());
    CHECK(total(pairs) == Approx(total(reverse)).margin(1e-6));
    std::vector<std::tuple<double, std::size_t, std::size_t>> near;
    for (std::size_t i = 0; i < reference.size(); ++i)
      for (std::size_t j = 0; j < other.size(); ++j)
        if (const double d = (reference[i] - other[j]).norm(); d <= radius) near.emplace_back(d, i, j);
    std::sort(near.begin(), near.end());
    std::set<std::size_t> used_i, used_j;
    for (const auto& [d, i, j] : near)
      if (!used_i.contains(i) && !used_j.contains(j)) {
        used_i.insert(i);
        used_j.insert(j);
      }
    CHECK(pairs.size() >= used_i.size());
  }
}

TEST_CASE(
    "beyond the bounds there are as many pairs, and a sum of distances that is said not to be the least") {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const auto reference = random_points(random() % 60, random);
    const auto other = random_points(random() % 60, random);
    for (const double radius : {0.05, 0.1, 0.3, 2.0}) {
      const tools::PointMatches least = PointMatcher(reference, radius).match(other);
      CHECK(least.is_least);
      CHECK(PointMatcher(reference, radius).count(other) == least.pairs.size());
      for (const tools::MatchingBounds& bounds :
           {tools::MatchingBounds{0, 1000, 2}, {0, 0, 2}, {1'000'000, 0, 2}}) {
        const tools::PointMatches bounded = PointMatcher(reference, radius, bounds).match(other);
        check_pairs(bounded.pairs, reference, other, radius);
        CHECK(bounded.pairs.size() == least.pairs.size());
        CHECK(total(bounded.pairs) >= total(least.pairs) - 1e-7);
        if (bounded.is_least) CHECK(total(bounded.pairs) == Approx(total(least.pairs)).margin(1e-7));
        if (least.pairs.size() > 1) CHECK_FALSE(bounded.is_least);
      }
    }
  }
}

TEST_CASE("pairs that are listed are as many beyond the bound of steps") {
  std::mt19937 random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const std::size_t references = 1 + random() % 30;
    std::vector<std::vector<tools::InReach>> reach(1 + random() % 30);
    for (auto& list : reach)
      for (core::Index i = 0; i < references; ++i)
        if (random() % 8 == 0) list.push_back({i, random() % 100 / 100.0});
    const tools::PointMatches least = tools::match_in_reach(reach, references, 1);
    const tools::PointMatches bounded = tools::match_in_reach(reach, references, 1, {0, 5, 0});
    CHECK(least.is_least);
    CHECK(bounded.pairs.size() == least.pairs.size());
    CHECK(total(bounded.pairs) >= total(least.pairs) - 1e-7);
    std::set<std::size_t> used;
    for (const PointPair& pair : bounded.pairs) {
      CHECK(used.insert(pair.reference).second);
      CHECK(std::ranges::any_of(reach[pair.other], [&](const tools::InReach& in) {
        return in.reference == pair.reference && in.distance == pair.distance;
      }));
    }
  }
}

TEST_CASE("bug: matching of points that are all in reach took time quadratic to cubic in their number") {
  std::mt19937 random(7);
  const auto reference = random_points(20'000, random);
  auto other = random_points(10'000, random);
  const PointMatcher matcher(reference, 2);
  CHECK(matcher.count(other) == other.size());
  const tools::PointMatches matches = matcher.match(other);
  CHECK(matches.pairs.size() == other.size());
  CHECK_FALSE(matches.is_least);
  check_pairs(matches.pairs, reference, other, 2);
  for (Point& p : other) p = p / 1000 + Point(1, 0, 0);  // all have the same references next to them
  CHECK(matcher.match(other).pairs.size() == other.size());
  const std::vector<Point> one(20'000, Point(1, 2, 3));
  CHECK(PointMatcher(one, 0).match(one).pairs.size() == one.size());
}

TEST_CASE("points of any size are counted as they are matched") {
  std::mt19937 random(8);
  for (const double size : {1e-200, 1.0, 1e150}) {
    auto reference = random_points(50, random);
    auto other = random_points(50, random);
    for (Point& p : reference) p *= size;
    for (Point& p : other) p *= size;
    const PointMatcher matcher(reference, 0.1 * size);
    CHECK(matcher.count(other) == matcher.match(other).pairs.size());
    CHECK(matcher.count(other) > 10);
    CHECK(matcher.count(other) < 50);
  }
}
