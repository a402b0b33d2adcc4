#include "morsel/morse/smoothing/denoise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/height.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::BilateralDenoising;
using morse::LaplacianDenoising;
using morse::SurfaceSmoothing;
namespace {

/// Of height along (1, 2, 3), or of another function.
core::MethodResult apply_denoise(const ScalarField& field, Given given, core::MethodContext context = {}) {
  if (!context.morse_function)
    context.morse_function = [](const TriangleMesh& mesh) { return morse::height(mesh, {{1, 2, 3}}); };
  return made(morse::make_denoise, "denoise", std::move(given))->apply(field, context);
}

Point plain_normal(const TriangleMesh& mesh, Index v) {
  Point sum = Point::Zero();
  for (const core::Triangle& t : mesh.triangles())
    if (t[0] == v || t[1] == v || t[2] == v)
      sum += (mesh.position(t[1]) - mesh.position(t[0])).cross(mesh.position(t[2]) - mesh.position(t[0]));
  return sum.normalized();
}

std::vector<Index> plain_ball(const TriangleMesh& mesh, Index v, double radius) {
  std::vector<Index> ball = {v};
  std::vector<Index> ring;
  for (std::size_t i = 0; i < ball.size(); ++i) {
    mesh.neighbors(ball[i], ring);
    for (const Index u : ring)
      if ((mesh.position(u) - mesh.position(v)).norm() <= radius &&
          std::find(ball.begin(), ball.end(), u) == ball.end())
        ball.push_back(u);
  }
  return ball;
}

/// The standard deviation of the distances from the origin.
double roughness(const TriangleMesh& mesh) {
  double mean = 0;
  double square = 0;
  for (const Point& p : mesh.positions()) mean += p.norm() / mesh.vertex_count();
  for (const Point& p : mesh.positions()) square += std::pow(p.norm() - mean, 2) / mesh.vertex_count();
  return std::sqrt(square);
}

}  // namespace

TEST_CASE("bilateral denoising agrees with its formula") {
  for (const NamedMesh& entry : mesh_zoo()) {
    if (entry.mesh.vertex_count() > 700) continue;
    INFO(entry.name);
    const TriangleMesh mesh = jittered(entry.mesh, 0.05, 3);
    const double sigma_c = 0.08 * mesh.bounding_box().diagonal();
    const double sigma_s = 0.3 * sigma_c;
    SurfaceSmoothing smoothing(
        mesh, BilateralDenoising{core::Length::absolute(sigma_c), core::Length::absolute(sigma_s)});
    CHECK(smoothing.sigma_c() == Approx(sigma_c));
    CHECK(smoothing.sigma_s() == Approx(sigma_s));
    smoothing.step({});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Point n = plain_normal(mesh, v);
      double sum = 0;
      double total = 0;
      for (const Index x : plain_ball(mesh, v, 2 * sigma_c)) {
        const Point d = mesh.position(x) - mesh.position(v);
        const double h = n.dot(d);
        const double weight =
            std::exp(-d.squaredNorm() / (2 * sigma_c * sigma_c)) * std::exp(-h * h / (2 * sigma_s * sigma_s));
        sum += weight * h;
        total += weight;
      }
      const Point expected = mesh.position(v) + n * sum / total;
      CHECK((smoothing.surface().position(v) - expected).norm() < 1e-13);
    }
  }
}

TEST_CASE("the defaults of denoising are the mean edge and the median of deviations") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.02, 3);
  double edge = 0;
  for (Index e = 0; e < mesh.edge_count(); ++e)
    edge += (mesh.position(mesh.edge_vertices(e)[0]) - mesh.position(mesh.edge_vertices(e)[1])).norm() /
            mesh.edge_count();
  std::vector<double> deviations;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<double> heights;
    double mean = 0;
    double square = 0;
    for (const Index x : plain_ball(mesh, v, 2 * edge))
      heights.push_back(plain_normal(mesh, v).dot(mesh.position(x) - mesh.position(v)));
    for (const double h : heights) mean += h / static_cast<double>(heights.size());
    for (const double h : heights) square += (h - mean) * (h - mean) / static_cast<double>(heights.size());
    deviations.push_back(std::sqrt(square));
  }
  std::sort(deviations.begin(), deviations.end());
  const SurfaceSmoothing smoothing(mesh, BilateralDenoising{});
  CHECK(smoothing.sigma_c() == Approx(edge));
  CHECK(smoothing.sigma_s() == Approx(deviations[(deviations.size() - 1) / 2]));
}

TEST_CASE("denoising at vertices of a degree of twenty thousand takes seconds, not minutes") {
  // The mean edge is nearly as long as the spokes, so that each ball of twice its length holds all vertices.
  const TriangleMesh mesh = jittered(bipyramid(20000).mesh(), 0.01, 5);
  SurfaceSmoothing smoothing(mesh, BilateralDenoising{});
  CHECK(smoothing.limits_balls());
  smoothing.step({});
  CHECK(smoothing.surface().position(2) != mesh.position(2));
}

TEST_CASE("limited balls hold the nearest vertices, and only balls of a default radius are limited") {
  const TriangleMesh mesh = jittered(bipyramid(600).mesh(), 0.01, 6);
  SurfaceSmoothing smoothing(mesh, BilateralDenoising{});
  REQUIRE(smoothing.limits_balls());
  smoothing.step({});
  const double sigma_c = smoothing.sigma_c();
  const double sigma_s = smoothing.sigma_s();
  for (Index v = 0; v < mesh.vertex_count(); v += 5) {
    std::vector<double> distances;
    for (const Point& p : mesh.positions()) distances.push_back((p - mesh.position(v)).norm());
    std::nth_element(distances.begin(), distances.begin() + (SurfaceSmoothing::kMostInBall - 1),
                     distances.end());
    const double reach = std::min(2 * sigma_c, distances[SurfaceSmoothing::kMostInBall - 1]);
    const Point n = plain_normal(mesh, v);
    double sum = 0;
    double total = 0;
    for (const Index x : plain_ball(mesh, v, reach)) {
      const Point d = mesh.position(x) - mesh.position(v);
      const double h = n.dot(d);
      const double weight =
          std::exp(-d.squaredNorm() / (2 * sigma_c * sigma_c)) * std::exp(-h * h / (2 * sigma_s * sigma_s));
      sum += weight * h;
      total += weight;
    }
    const Point expected = mesh.position(v) + n * sum / total;
    CHECK((smoothing.surface().position(v) - expected).norm() < 1e-13);
  }
  CHECK_FALSE(SurfaceSmoothing(mesh, BilateralDenoising{core::Length::edges(1), {}}).limits_balls());
  CHECK_FALSE(SurfaceSmoothing(jittered(sphere(4).mesh(), 0.01, 7), BilateralDenoising{}).limits_balls());
  // As many as a ball may hold.
  CHECK_FALSE(
      SurfaceSmoothing(jittered(bipyramid(250).mesh(), 0.01, 8), BilateralDenoising{}).limits_balls());
}

TEST_CASE("Laplacian denoising agrees with its formula and holds boundaries") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const morse::EdgeWeights weights :
         {morse::EdgeWeights::uniform, morse::EdgeWeights::clamped, morse::EdgeWeights::cotangent}) {
      INFO(entry.name << ", " << to_string(weights));
      const TriangleMesh mesh = jittered(entry.mesh, 0.05, 3);
      const std::vector<double> weight = morse::edge_weights(mesh, weights);
      SurfaceSmoothing smoothing(mesh, LaplacianDenoising{0.3, weights});
      smoothing.step({});
      std::vector<Point> expected(mesh.vertex_count(), Point::Zero());
      std::vector<double> total(mesh.vertex_count(), 0.0);
      for (Index e = 0; e < mesh.edge_count(); ++e) {
        const auto [a, b] = mesh.edge_vertices(e);
        expected[a] += weight[e] * (mesh.position(b) - mesh.position(a));
        expected[b] += weight[e] * (mesh.position(a) - mesh.position(b));
        total[a] += weight[e];
        total[b] += weight[e];
      }
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const bool stays = mesh.is_boundary_vertex(v) || !(total[v] > 0);
        const Point place = mesh.position(v) + (stays ? Point::Zero() : Point(0.3 * expected[v] / total[v]));
        CHECK((smoothing.surface().position(v) - place).norm() < 1e-11);
      }
    }
}

TEST_CASE("denoising leaves a plane where it is and brings a noisy sphere nearer to the sphere") {
  const TriangleMesh plane = grid(12, 9).mesh();
  SurfaceSmoothing flat(plane, BilateralDenoising{});
  CHECK(flat.sigma_s() == 0);
  flat.step({});
  SurfaceSmoothing flat_too(plane, BilateralDenoising{{}, core::Length::absolute(0.1)});
  flat_too.step({});
  for (Index v = 0; v < plane.vertex_count(); ++v) {
    CHECK(flat.surface().position(v) == plane.position(v));
    CHECK(flat_too.surface().position(v) == plane.position(v));
  }
  const TriangleMesh noisy = jittered(sphere(4).mesh(), 0.01, 3);
  SurfaceSmoothing smoothing(noisy, BilateralDenoising{core::Length::absolute(0.1), {}});
  for (int i = 0; i < 3; ++i) smoothing.step({});
  CHECK(roughness(smoothing.surface()) < 0.4 * roughness(noisy));
}

TEST_CASE("the denoised field is the function of the smoothed surface on the original one") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.02, 3);
  const ScalarField field = morse::height(mesh, {{1, 2, 3}});
  for (const char* kind : {"bilateral", "laplacian"}) {
    const core::MethodResult result = apply_denoise(field, {{"kind", kind}, {"iterations", "3"}});
    SurfaceSmoothing smoothing = *kind == 'b' ? SurfaceSmoothing(mesh, BilateralDenoising{})
                                              : SurfaceSmoothing(mesh, LaplacianDenoising{});
    for (int i = 0; i < 3; ++i) smoothing.step({});
    CHECK(values_of(result.field) == values_of(morse::height(smoothing.surface(), {{1, 2, 3}})));
    CHECK(result.field.mesh().is_same(mesh));
    double largest = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      largest = std::max(largest, (smoothing.surface().position(v) - mesh.position(v)).norm());
    REQUIRE(result.details.size() == 5);
    CHECK(result.details[0].first == "largest_displacement");
    CHECK(std::get<double>(result.details[0].second) == Approx(largest));
    CHECK(result.details[1].first == "mean_displacement");
    CHECK(result.details[2].first == "volume_change");
    CHECK(std::abs(std::get<double>(result.details[2].second)) < 0.1);
    if (*kind == 'l') {
      CHECK(std::get<double>(result.details[2].second) < -0.01);  // it shrinks
      CHECK(result.parameters == core::Parameters{{"iterations", std::int64_t{3}},
                                                  {"kind", "laplacian"},
                                                  {"lambda", 0.5},
                                                  {"weights", "uniform"}});
    }
  }
  CHECK(values_of(apply_denoise(field, {{"iterations", "0"}}).field) == values_of(field));
}

TEST_CASE("denoising evaluates the Morse function only where a stop condition needs it") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.05, 3);
  int calls = 0;
  core::MethodContext context;
  context.morse_function = [&](const TriangleMesh& surface) {
    ++calls;
    return morse::mean_curvature(surface);
  };
  const ScalarField field = morse::mean_curvature(mesh);
  const core::MethodResult plain = apply_denoise(field, {{"iterations", "6"}}, context);
  CHECK(calls == 1);
  CHECK(plain.iterations.empty());
  context.count_iterations = true;
  const core::MethodResult counted = apply_denoise(field, {{"iterations", "6"}}, context);
  CHECK(calls == 7);
  CHECK(counted.iterations.size() == 7);
  CHECK(values_of(counted.field) == values_of(plain.field));
  context.count_iterations = false;
  calls = 0;
  const std::size_t goal = counted.iterations[3].total();
  const core::MethodResult until = apply_denoise(field, {{"until-count", std::to_string(goal)}}, context);
  CHECK(until.iterations.back().total() <= goal);
  CHECK(calls == static_cast<int>(until.iterations.size()) - 1);
  calls = 0;
  apply_denoise(field, {{"until-change", "0.01"}, {"iterations", "40"}}, context);
  CHECK(calls > 1);
}

TEST_CASE("denoising needs a Morse function and reports where it fails or ignores positions") {
  const TriangleMesh mesh = jittered(sphere(2).mesh(), 0.05, 3);
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 3));
  core::ParameterReader reader({"denoise", {}});
  CHECK_THROWS_AS(morse::make_denoise(reader)->apply(field, {}), core::InvalidArgument);
  core::MethodContext context;
  context.morse_function = [](const TriangleMesh&) -> ScalarField { throw core::BadInput("no such luck"); };
  CHECK_THROWS_WITH(apply_denoise(field, {{"iterations", "4"}}, context),
                    Catch::Contains("after 4 iterations of denoising") && Catch::Contains("no such luck"));
  CHECK_THROWS_AS(apply_denoise(field, {}, context), core::BadInput);
  context.morse_function = [&](const TriangleMesh&) { return field; };
  CHECK(apply_denoise(field, {}, context).details[3].first == "unchanged_because");
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  CHECK_THROWS_AS(apply_denoise({point, values_of(field)}, {}), core::BadInput);
}

TEST_CASE("denoising turns with the surface and scales exactly by powers of two") {
  const TriangleMesh mesh = jittered(torus(24, 17).mesh(), 0.05, 5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto run = [](SurfaceSmoothing smoothing) {
    for (int i = 0; i < 3; ++i) smoothing.step({});
    return smoothing.surface();
  };
  const auto both = [&](const TriangleMesh& surface) {
    return std::pair(run({surface, BilateralDenoising{}}),
                     run({surface, LaplacianDenoising{0.5, morse::EdgeWeights::clamped}}));
  };
  const auto [a, b] = both(mesh);
  const auto [turned_a, turned_b] = both(moved(mesh, 3 * turn, {7, -4, 2}));
  const auto [tiny_a, tiny_b] = both(scaled(mesh, 0x1p-600));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK((turned_a.position(v) - (3 * (turn * a.position(v)) + Point(7, -4, 2))).norm() < 1e-12);
    CHECK((turned_b.position(v) - (3 * (turn * b.position(v)) + Point(7, -4, 2))).norm() < 1e-12);
    CHECK(tiny_a.position(v) == a.position(v) * 0x1p-600);
    CHECK(tiny_b.position(v) == b.position(v) * 0x1p-600);
  }
}

TEST_CASE("denoising gives the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(5).mesh(), 0.01, 5);
  const ScalarField field = morse::height(mesh);
  for (const char* kind : {"bilateral", "laplacian"}) {
    const auto run = [&](int threads) {
      const core::ThreadLimit limit(threads);
      return apply_denoise(field, {{"kind", kind}, {"iterations", "2"}});
    };
    const core::MethodResult one = run(1);
    const core::MethodResult four = run(4);
    CHECK(values_of(one.field) == values_of(four.field));
    CHECK(one.details == four.details);
  }
}

TEST_CASE("denoise keys are checked") {
  const ScalarField field = morse::height(octahedron().mesh());
  const Given bad = {{"kind", "median"},     {"sigma-c", "0"},    {"sigma-c", "-1eps"}, {"sigma-s", "0"},
                     {"sigma-s", "nan"},     {"sigma-c", "wide"}, {"iterations", "-1"}, {"lambda", "0.5"},
                     {"weights", "uniform"}, {"sigma", "8eps"}};
  for (const auto& [key, value] : bad) {
    INFO(key << "=" << value);
    CHECK_THROWS_AS(apply_denoise(field, {{key, value}}), core::InvalidArgument);
    CHECK_THROWS_WITH(apply_denoise(field, {{key, value}}),
                      Catch::Contains("denoise") && Catch::Contains(key));
  }
  for (const auto& [key, value] :
       Given{{"lambda", "0"}, {"lambda", "1.5"}, {"weights", "area"}, {"sigma-c", "1"}})
    CHECK_THROWS_WITH(apply_denoise(field, {{"kind", "laplacian"}, {key, value}}), Catch::Contains(key));
  CHECK_THROWS_AS(SurfaceSmoothing(field.mesh(), LaplacianDenoising{2}), core::InvalidArgument);
  CHECK_THROWS_AS(SurfaceSmoothing(field.mesh(), BilateralDenoising{core::Length::absolute(-1), {}}),
                  core::InvalidArgument);
}

TEST_CASE("counts of denoised samples") {
  const auto total = [](const char* file, Given given) {
    core::MethodContext context;
    context.morse_function = [](const TriangleMesh& mesh) { return morse::mean_curvature(mesh); };
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    return morse::classify(apply_denoise(field, std::move(given), context).field).total();
  };
  CHECK(total("lion-head.off", {}) == 2524);
  CHECK(total("lion-head.off", {{"kind", "laplacian"}}) == 2039);
  CHECK(total("lion-head.off", {{"kind", "laplacian"}, {"weights", "clamped"}}) == 1300);
  CHECK(total("bunny00.off", {}) == 8709);
  CHECK(total("bunny00.off", {{"kind", "laplacian"}}) == 8165);
}
