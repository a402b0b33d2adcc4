// weights=area and ball=connected.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/operators/laplacian.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/salient_reference.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::Ball;
using morse::NeighborWeights;
using morse::SalientOptions;

namespace {

SalientOptions options(int iterations, double sigma, const char* range, NeighborWeights weights, Ball ball) {
  SalientOptions result;
  result.iterations = iterations;
  result.sigma = core::Length::absolute(sigma);
  result.range = morse::parse_value_range(range, "range");
  result.weights = weights;
  result.ball = ball;
  return result;
}

/// Halves the edges of the triangles that lie above the equator and puts the new vertices on the unit sphere;
/// other triangles at such an edge are halved.
Soup finer_above(const Soup& soup) {
  Soup result;
  result.positions = soup.positions;
  std::map<std::pair<Index, Index>, Index> middles;
  const auto edge = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const core::Triangle& t : soup.triangles) {
    if ((soup.positions[t[0]] + soup.positions[t[1]] + soup.positions[t[2]]).z() <= 0) continue;
    for (int i = 0; i < 3; ++i) {
      const Index a = t[static_cast<std::size_t>(i)];
      const Index b = t[static_cast<std::size_t>((i + 1) % 3)];
      if (!middles.emplace(edge(a, b), static_cast<Index>(result.positions.size())).second) continue;
      result.positions.push_back((soup.positions[a] + soup.positions[b]).normalized());
    }
  }
  // One edge after the other: what is left of a triangle is cut from the middle to the opposite corner.
  const std::function<void(core::Triangle)> cut = [&](const core::Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i];
      const Index b = t[(i + 1) % 3];
      const Index c = t[(i + 2) % 3];
      const auto middle = middles.find(edge(a, b));
      if (middle == middles.end()) continue;
      const Index m = middle->second;
      const auto next = middles.find(edge(b, c));
      const auto last = middles.find(edge(c, a));
      if (next != middles.end() && last != middles.end()) {
        result.triangles.push_back({a, m, last->second});
        result.triangles.push_back({m, b, next->second});
        result.triangles.push_back({last->second, next->second, c});
        result.triangles.push_back({m, next->second, last->second});
      } else {
        cut({a, m, c});
        cut({m, b, c});
      }
      return;
    }
    result.triangles.push_back(t);
  };
  for (const core::Triangle& t : soup.triangles) cut(t);
  return result;
}

}  // namespace

TEST_CASE("salient smoothing with areas and connected balls agrees with its listing") {
  for (const NamedMesh& entry : mesh_zoo()) {
    if (entry.mesh.vertex_count() > 700) continue;
    const TriangleMesh mesh = jittered(entry.mesh, 0.02, 3);
    const std::vector<double> values = random_values(mesh.vertex_count(), 7);
    const double sigma = 0.06 * mesh.bounding_box().diagonal();
    for (const NeighborWeights weights : {NeighborWeights::none, NeighborWeights::area})
      for (const Ball ball : {Ball::euclidean, Ball::connected})
        for (const char* range : {"0.4", "local"}) {
          if (weights == NeighborWeights::none && ball == Ball::euclidean) continue;
          INFO(entry.name << ", weights=" << to_string(weights) << ", ball=" << to_string(ball) << ", "
                          << range);
          SalientReferenceOptions slow{3, sigma, 2, 0.4};
          if (*range == 'l') slow.sigma_s.reset();
          if (weights == NeighborWeights::area) slow.weights = vertex_areas(mesh, morse::VertexArea::mixed);
          if (ball == Ball::connected) slow.connected_by = &mesh;
          const std::vector<double> expected = salient_reference(mesh.positions(), values, slow);
          SalientOptions fast = options(3, sigma, range, weights, ball);
          for (const morse::InstructionSet set : morse::instruction_sets()) {
            fast.instructions = set;
            const auto result = morse::salient({mesh, values}, fast);
            for (Index v = 0; v < mesh.vertex_count(); ++v)
              CHECK(result.field.value(v) == Approx(expected[v]).margin(1e-12));
          }
        }
  }
}

TEST_CASE("weights by area make up for a finer half") {
  const Soup coarse = sphere(3);
  const TriangleMesh mesh = coarse.mesh();
  const TriangleMesh finer = finer_above(finer_above(coarse)).mesh();
  REQUIRE(finer.euler_characteristic() == 2);
  REQUIRE(finer.vertex_count() > 8 * mesh.vertex_count());
  const auto field = [](const TriangleMesh& surface) {
    std::vector<double> values;
    for (const Point& p : surface.positions()) values.push_back(p.z() + 0.3 * std::sin(7 * p.x()));
    return ScalarField(surface, std::move(values));
  };
  const auto difference = [&](NeighborWeights weights, const char* range) {
    const SalientOptions chosen = options(3, 0.2, range, weights, Ball::euclidean);
    const ScalarField a = morse::salient(field(mesh), chosen).field;
    const ScalarField b = morse::salient(field(finer), chosen).field;
    double most = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) most = std::max(most, std::abs(a.value(v) - b.value(v)));
    return most;
  };
  for (const char* range : {"1std", "none"}) {
    INFO(range);
    const double without = difference(NeighborWeights::none, range);
    const double with = difference(NeighborWeights::area, range);
    CHECK(without > 0.1);
    CHECK(with < 0.025);
    CHECK(5 * with < without);
  }
}

TEST_CASE("the standard deviation counts areas") {
  const TriangleMesh mesh = jittered(sphere(2).mesh(), 0.2, 3);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 5));
  const std::vector<double> area = vertex_areas(mesh, morse::VertexArea::mixed);
  double total = 0;
  double mean = 0;
  double square = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) total += area[v];
  for (Index v = 0; v < mesh.vertex_count(); ++v) mean += area[v] / total * field.value(v);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    square += area[v] / total * std::pow(field.value(v) - mean, 2);
  const auto result = morse::salient(field, options(1, 0.2, "2std", NeighborWeights::area, Ball::euclidean));
  CHECK(*result.sigma_s == Approx(2 * std::sqrt(square)));
}

TEST_CASE("connected balls keep two near sheets apart") {
  const Soup lower = grid(15, 15);
  Soup upper = grid(15, 15);
  for (Point& p : upper.positions) p.z() += 0.2;
  const TriangleMesh alone = lower.mesh();
  const TriangleMesh both = together(lower, upper).mesh();
  std::vector<double> values = random_values(225, 3);
  const ScalarField field_alone(alone, values);
  for (const double value : random_values(225, 4)) values.push_back(value + 1);
  const ScalarField field_both(both, values);
  for (const NeighborWeights weights : {NeighborWeights::none, NeighborWeights::area}) {
    const auto connected = options(4, 1.1, "2", weights, Ball::connected);
    const auto euclidean = options(4, 1.1, "2", weights, Ball::euclidean);
    const ScalarField one = morse::salient(field_alone, connected).field;
    const ScalarField two = morse::salient(field_both, connected).field;
    const ScalarField mixed = morse::salient(field_both, euclidean).field;
    double most = 0;
    for (Index v = 0; v < 225; ++v) {
      CHECK(two.value(v) == Approx(one.value(v)).epsilon(1e-13));
      most = std::max(most, std::abs(mixed.value(v) - two.value(v)));
    }
    CHECK(most > 0.2);
  }
}

TEST_CASE("connected balls and areas give the same bits at any number of threads and any memory") {
  const TriangleMesh mesh = jittered(torus(60, 40).mesh(), 0.01, 3);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 9));
  for (const Ball ball : {Ball::euclidean, Ball::connected}) {
    SalientOptions chosen = options(3, 0.3, "1std", NeighborWeights::area, ball);
    const auto run = [&](int threads, std::size_t memory) {
      const core::ThreadLimit limit(threads);
      chosen.memory = memory;
      return values_of(morse::salient(field, chosen).field);
    };
    const std::vector<double> expected = run(1, std::size_t{1} << 30);
    CHECK(run(4, std::size_t{1} << 30) == expected);
    CHECK(run(4, 0) == expected);
    CHECK(run(3, 200000) == expected);
  }
}

TEST_CASE("areas and connected balls scale with the mesh and survive vertices without area") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.05, 3);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 9));
  std::vector<Point> line(mesh.positions().begin(), mesh.positions().end());
  for (Point& p : line) p = {p.x(), 0, 0};
  for (const Ball ball : {Ball::euclidean, Ball::connected})
    for (const char* range : {"1std", "local", "none"}) {
      INFO(to_string(ball) << ", " << range);
      const auto run = [&](const TriangleMesh& surface, double unit) {
        return values_of(morse::salient({surface, values_of(field)},
                                        options(3, 0.2 * unit, range, NeighborWeights::area, ball))
                             .field);
      };
      const std::vector<double> expected = run(mesh, 1);
      CHECK(run(scaled(mesh, 0x1p-700), 0x1p-700) == expected);
      CHECK(run(scaled(mesh, 0x1p400), 0x1p400) == expected);
      CHECK(run(mesh.with_positions(line), 1) == values_of(field));
    }
}

TEST_CASE("a vertex without area counts for nothing and takes the mean of the others") {
  // The middle of the line is in no triangle with an area.
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}}, {{0, 1, 2}, {2, 1, 3}});
  const std::vector<double> area = vertex_areas(mesh, morse::VertexArea::mixed);
  REQUIRE(area[3] == 0);
  const ScalarField field(mesh, {1, 2, 5, 100});
  const auto result = morse::salient(field, options(1, 10, "none", NeighborWeights::area, Ball::euclidean));
  double sum = 0;
  double total = 0;
  for (Index v = 0; v < 3; ++v) {
    const double w = std::exp(-(mesh.position(v) - mesh.position(3)).squaredNorm() / 200) * area[v];
    sum += w * field.value(v);
    total += w;
  }
  CHECK(result.field.value(3) == Approx(sum / total).epsilon(1e-13));
  CHECK(result.field.value(0) < 5);
}

TEST_CASE("options that do not go with areas and connected balls") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 9));
  SalientOptions chosen = options(2, 0.5, "1std", NeighborWeights::area, Ball::connected);
  const morse::SalientResult exact = morse::salient(field, chosen);
  chosen.accuracy = 1e-4;
  const morse::SalientResult result = morse::salient(field, chosen);
  CHECK(values_of(result.field) == values_of(exact.field));
  CHECK(result.promised_error == 0);
  CHECK_THAT(result.reason, Catch::Contains("every pair"));
  chosen.precision = morse::Precision::float32;
  CHECK_THROWS_WITH(morse::salient(field, chosen), Catch::Contains("precision=single"));
}

TEST_CASE("counts with areas and connected balls on the samples") {
  const auto total = [](const char* file, NeighborWeights weights, Ball ball) {
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    SalientOptions chosen;
    chosen.weights = weights;
    chosen.ball = ball;
    chosen.iterations = 5;
    return morse::classify(morse::salient(field, chosen).field).total();
  };
  CHECK(total("lion-head.off", NeighborWeights::area, Ball::euclidean) == 371);
  CHECK(total("lion-head.off", NeighborWeights::none, Ball::connected) == 137);
  CHECK(total("bunny00.off", NeighborWeights::area, Ball::connected) == 993);
}
