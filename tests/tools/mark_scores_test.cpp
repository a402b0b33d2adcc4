#include "morsel/tools/study/mark_scores.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/study/bootstrap.h"
#include "morsel/tools/study/chance_points.h"
#include "support/path_oracle.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using morse::SurfaceDistances;
using tools::MarkScore;
using tools::MarkScorer;
using tools::RandomStream;
using tools::RandomUse;

namespace {

using Vertices = std::vector<Index>;

/// On a strip whose first nine vertices lie at 0 … 8.
MarkScore on_strip(const Vertices& marks, const Vertices& points, double radius) {
  const SurfaceDistances distances(grid(9, 2).mesh());
  return MarkScorer(distances, marks, radius, {0, 1, 2, 3}).score(points);
}

/// Some different vertices.
Vertices some(const TriangleMesh& mesh, std::size_t count, std::mt19937& random) {
  Vertices all(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) all[v] = v;
  std::shuffle(all.begin(), all.end(), random);
  all.resize(std::min(count, all.size()));
  return all;
}

template <class Predicate>
std::size_t count(const Vertices& vertices, const Predicate& predicate) {
  return static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), predicate));
}

bool any_within(const std::vector<double>& distance, const Vertices& others, double radius) {
  return std::any_of(others.begin(), others.end(), [&](Index v) { return distance[v] <= radius; });
}

/// The most pairs within the radius, and the least sum of their distances, of all ways to match.
std::pair<std::size_t, double> best_matching(const std::vector<std::vector<double>>& distance,
                                             const Vertices& marks, const Vertices& points, double radius) {
  std::pair<std::size_t, double> best{0, 0};
  std::vector<bool> taken(marks.size(), false);
  const std::function<void(std::size_t, std::size_t, double)> go = [&](std::size_t j, std::size_t pairs,
                                                                       double sum) {
    if (j == points.size()) {
      if (pairs > best.first || (pairs == best.first && sum < best.second)) best = {pairs, sum};
      return;
    }
    go(j + 1, pairs, sum);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const double d = distance[marks[i]][points[j]];
      if (taken[i] || d > radius) continue;
      taken[i] = true;
      go(j + 1, pairs + 1, sum + d);
      taken[i] = false;
    }
  };
  go(0, 0, 0);
  return best;
}

/// Marks with a point within the radius whose nearest mark they are.
std::size_t detected(const std::vector<std::vector<double>>& distance, const Vertices& marks,
                     const Vertices& points, double radius) {
  std::vector<bool> is_detected(marks.size(), false);
  for (const Index p : points) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < marks.size(); ++i)
      if (distance[marks[i]][p] < distance[marks[nearest]][p]) nearest = i;
    if (distance[marks[nearest]][p] <= radius) is_detected[nearest] = true;
  }
  return static_cast<std::size_t>(std::count(is_detected.begin(), is_detected.end(), true));
}

}  // namespace

TEST_CASE("scores that are computed by hand") {
  const MarkScore score = on_strip({0, 5}, {1, 2, 6, 8}, 2);
  CHECK((score.marks() == 2 && score.points() == 4));
  CHECK((score.marks_hit == 2 && score.points_hit == 3));
  CHECK(score.recall() == 1);
  CHECK(score.precision() == 0.75);
  CHECK(score.f_score() == Approx(6.0 / 7));
  CHECK(score.one_to_one.matched == 2);
  CHECK(score.one_to_one.distances == Approx(2));  // 0 with 1, 5 with 6
  CHECK(score.one_to_one.f_score() == Approx(2.0 / 3));
  CHECK(score.detected == 2);
  CHECK(score.false_negatives() == 0);
  CHECK(score.false_positives() == 0.5);
  CHECK(score.detected_within == std::vector<std::size_t>{0, 2, 2, 2});
  CHECK(score.false_negatives(0) == 1);
  CHECK(score.false_positives(0) == 1);
}

TEST_CASE("three ways to count differ where marks or points are near one another") {
  // One point between two marks hits both, is matched with one and detects the first.
  const MarkScore between = on_strip({0, 2}, {1}, 1);
  CHECK((between.marks_hit == 2 && between.points_hit == 1));
  CHECK((between.one_to_one.matched == 1 && between.detected == 1));
  CHECK(between.f_score() == 1);
  CHECK(between.one_to_one.f_score() == Approx(2.0 / 3));
  CHECK(between.false_negatives() == 0.5);
  // Two points near one mark, of which one is in reach of the other: more pairs than detected marks.
  const MarkScore crowded = on_strip({0, 3}, {0, 1}, 2);
  CHECK((crowded.one_to_one.matched == 2 && crowded.detected == 1));
  CHECK(crowded.one_to_one.distances == Approx(2));
  // One mark, many points around it.
  const MarkScore many = on_strip({4}, {3, 4, 5}, 1);
  CHECK((many.precision() == 1 && many.recall() == 1));
  CHECK(many.one_to_one.precision() == Approx(1.0 / 3));
  CHECK(many.one_to_one.distances == 0);
}

TEST_CASE("radii are inclusive, and without points there is nothing wrong but all is missed") {
  CHECK(on_strip({0}, {2}, 2).marks_hit == 1);
  CHECK(on_strip({0}, {2}, 1.999).marks_hit == 0);
  CHECK(on_strip({0, 3}, {3, 4}, 0).points_hit == 1);
  CHECK(on_strip({0, 3}, {3, 4}, 0).one_to_one.matched == 1);
  const MarkScore none = on_strip({0, 3}, {}, 2);
  CHECK((none.recall() == 0 && none.precision() == 1 && none.f_score() == 0));
  CHECK((none.false_negatives() == 1 && none.false_positives() == 0));
  CHECK(none.one_to_one.f_score() == 0);
  const MarkScore missed = on_strip({0}, {8}, 2);
  CHECK((missed.f_score() == 0 && missed.false_positives() == 1));
}

TEST_CASE("scores agree with brute force on random surfaces") {
  std::mt19937 random(7);
  for (unsigned seed = 0; seed < 80; ++seed) {
    INFO("seed " << seed);
    const TriangleMesh mesh = jittered(random_surface(seed), 0.02, seed);  // no two distances are equal
    const auto distance = all_distances(mesh);
    const SurfaceDistances distances(mesh);
    const Vertices marks = some(mesh, 1 + random() % 5, random);
    const Vertices points = some(mesh, random() % 6, random);
    const double diagonal = mesh.bounding_box().diagonal();
    const std::vector<double> curve = {0.0513 * diagonal, 0.2117 * diagonal, 0.4909 * diagonal};
    for (const double radius : curve) {
      const MarkScore score = MarkScorer(distances, marks, radius, curve).score(points);
      CHECK(score.marks_hit ==
            count(marks, [&](Index m) { return any_within(distance[m], points, radius); }));
      CHECK(score.points_hit ==
            count(points, [&](Index p) { return any_within(distance[p], marks, radius); }));
      const auto [pairs, sum] = best_matching(distance, marks, points, radius);
      CHECK(score.one_to_one.matched == pairs);
      CHECK(score.one_to_one.distances == Approx(sum).margin(1e-7 * diagonal));
      CHECK(score.detected == detected(distance, marks, points, radius));
      for (std::size_t k = 0; k < curve.size(); ++k)
        CHECK(score.detected_within[k] == detected(distance, marks, points, curve[k]));
      CHECK(score.detected <= score.one_to_one.matched);
    }
  }
}

TEST_CASE("random points lie apart, are as many as there is room for, and follow the area") {
  const TriangleMesh ball = jittered(sphere(3).mesh(), 0.01, 2);
  const SurfaceDistances distances(ball);
  const auto draw = [&](std::size_t count, double spacing, std::uint64_t set) {
    return tools::random_points(ball, distances, count, spacing,
                                RandomStream(1, RandomUse::random_points, {set}));
  };
  const Vertices ten = draw(10, 0.5, 0);
  CHECK(ten.size() == 10);
  for (const double apart : distances.to_nearest_other(ten)) CHECK(apart >= 0.5);
  CHECK(draw(10, 0.5, 0) == ten);
  CHECK(draw(10, 0.5, 1) != ten);
  CHECK(draw(1'000'000, 0.5, 0).size() < 100);
  Vertices all = draw(1'000'000, 0, 0);
  CHECK(all.size() == ball.vertex_count());

  // Two spheres of the same triangles, one of twice the size: four fifths of the first points are on it.
  const TriangleMesh two = [] {
    Soup soup = together(sphere(2), sphere(2));
    const std::size_t half = soup.positions.size() / 2;
    const Point middle = soup.positions[half] - sphere(2).positions[0];
    for (std::size_t v = half; v < 2 * half; ++v)
      soup.positions[v] = 2 * (soup.positions[v] - middle) + Point(10, 0, 0);
    return soup.mesh();
  }();
  const SurfaceDistances of_two(two);
  int large = 0;
  constexpr int kDraws = 1000;
  for (int set = 0; set < kDraws; ++set)
    if (tools::random_points(two, of_two, 1, 0,
                             RandomStream(1, RandomUse::random_points, {std::uint64_t(set)}))[0] >=
        two.vertex_count() / 2)
      ++large;
  CHECK(large == Approx(0.8 * kDraws).margin(4 * std::sqrt(0.16 * kDraws)));
}

TEST_CASE("spread points begin at an end") {
  const SurfaceDistances strip(grid(9, 2).mesh());
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Vertices ends = tools::spread_points(strip, 2, RandomStream(seed, RandomUse::spread_points, {}));
    REQUIRE(ends.size() == 2);
    for (const Index v : ends) CHECK((v == 0 || v == 8 || v == 9 || v == 17));
  }
}

TEST_CASE("bootstrap intervals of cases that are known") {
  const tools::Bootstrap two(2, 10'000, 1);
  const std::vector<double> equal = {3, 3};
  CHECK((two.of_mean(equal)->low == 3 && two.of_mean(equal)->high == 3));
  const std::vector<double> bits = {0, 1};  // means are 0, ½ and 1, a quarter of them 0
  CHECK((two.of_mean(bits)->low == 0 && two.of_mean(bits)->high == 1));
  CHECK_FALSE(tools::Bootstrap(1, 100, 1).of_mean(std::vector<double>{3}));

  std::vector<double> normal;
  RandomStream random(5, RandomUse::placement, {});
  for (int i = 0; i < 400; ++i) normal.push_back(random.normal());
  const tools::Estimate known = tools::estimate(normal);
  const tools::Bootstrap bootstrap(normal.size(), 10'000, 1);
  const tools::Interval interval = *bootstrap.of_mean(normal);
  CHECK(interval.low == Approx(known.mean - *known.half_width).margin(0.05 * *known.half_width));
  CHECK(interval.high == Approx(known.mean + *known.half_width).margin(0.05 * *known.half_width));
  std::vector<double> shifted = normal;
  for (double& value : shifted) value += 2;
  CHECK(bootstrap.of_mean(shifted)->low == Approx(interval.low + 2));  // the same resamples
  CHECK(tools::Bootstrap(400, 10'000, 2).of_mean(normal)->low != interval.low);
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    CHECK(tools::Bootstrap(400, 10'000, 1).of_mean(normal)->low == interval.low);
  }
  CHECK_THROWS_WITH(tools::Bootstrap(2, 99, 1), Catch::Contains("at least 100 resamples, not 99"));
}
