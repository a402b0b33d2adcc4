#include "morsel/morse/operators/low_pass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/curvature_functions.h"
#include "morsel/morse/functions/height.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::Length;
using core::ScalarField;
using morse::low_pass;

namespace {

std::vector<Point> positions_of(const TriangleMesh& mesh) {
  return {mesh.positions().begin(), mesh.positions().end()};
}

double largest_distance(const TriangleMesh& a, const std::vector<Point>& b) {
  double most = 0;
  for (std::size_t v = 0; v < b.size(); ++v)
    most = std::max(most, (a.position(static_cast<Index>(v)) - b[v]).norm());
  return most;
}

/// One vertex after the other: the mean of its neighbours, at a boundary of those along it.
std::vector<Point> plain_averages(const TriangleMesh& mesh, const std::vector<Point>& values) {
  std::vector<Point> sum(values.size(), Point::Zero());
  std::vector<double> count(values.size(), 0);
  for (Index e = 0; e < mesh.edge_count(); ++e) {
    const auto [a, b] = mesh.edge_vertices(e);
    for (const auto& [to, from] : {std::pair(a, b), std::pair(b, a)})
      if (!mesh.is_boundary_vertex(to) || mesh.is_boundary_edge(e)) {
        sum[to] += values[from];
        count[to] += 1;
      }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= count[v];
  return sum;
}

/// exp(−ln 2 (k/k_c)²) as so many small steps x ← x − (λK)² x, which are Taubin's pairs of steps with μ = −λ.
std::vector<Point> plain_low_pass(const TriangleMesh& mesh, double scale, int steps) {
  const double edge = core::mean_edge_length(mesh);
  const double cutoff = std::pow(edge / (2 * scale), 2);
  const double square = std::log(2) / (cutoff * cutoff) / steps;  // λ²
  std::vector<Point> values = positions_of(mesh);
  for (int i = 0; i < steps; ++i) {
    std::vector<Point> once = plain_averages(mesh, values);
    for (std::size_t v = 0; v < once.size(); ++v) once[v] = values[v] - once[v];
    const std::vector<Point> mean = plain_averages(mesh, once);
    for (std::size_t v = 0; v < once.size(); ++v) values[v] -= square * (once[v] - mean[v]);
  }
  return values;
}

core::MethodContext with_mean_curvature() {
  core::MethodContext context;
  context.morse_function = [](const TriangleMesh& mesh) { return morse::mean_curvature(mesh); };
  return context;
}

ScalarField curvature_at(const TriangleMesh& mesh, const char* scale) {
  return made(morse::make_mean_curvature, "mean-curvature", {{"scale", scale}})->evaluate(mesh, {}).field;
}

}  // namespace

TEST_CASE("the low-pass filter is the limit of many steps of Taubin's") {
  for (const NamedMesh& entry : mesh_zoo()) {
    if (entry.mesh.vertex_count() > 700) continue;
    INFO(entry.name);
    const TriangleMesh mesh = jittered(entry.mesh, 0.05, 3);
    const double diagonal = mesh.bounding_box().diagonal();
    const double scale = std::min(0.8 * core::mean_edge_length(mesh), 0.5 * diagonal);
    const TriangleMesh filtered = low_pass(mesh, Length::absolute(scale));
    const double rough = largest_distance(filtered, plain_low_pass(mesh, scale, 1000));
    const double fine = largest_distance(filtered, plain_low_pass(mesh, scale, 4000));
    CHECK(fine < 1e-3 * diagonal);
    CHECK(fine <= 0.3 * rough + 1e-8 * diagonal);  // the error of steps, not of the filter
  }
}

TEST_CASE("a wave of 2 pi times the scale keeps half of its height") {
  // Rows of even triangles around a cylinder, whose boundaries are far off.
  const int around = 48;
  const TriangleMesh mesh = cylinder(1, around, 80).mesh();
  const double edge = core::mean_edge_length(mesh);
  const double length = 12 * edge * std::sqrt(3.0) / 2;  // along the axis: 12 rows
  for (const double ratio : {0.5, 1.0, 2.0}) {
    const double scale = ratio * length / (2 * std::numbers::pi);
    const auto radius = [&](const TriangleMesh& surface, Index v) {
      return std::hypot(surface.position(v).x(), surface.position(v).y());
    };
    std::vector<Point> waved = positions_of(mesh);
    const auto wave = [&](const Point& p) { return std::cos(2 * std::numbers::pi * p.z() / length); };
    for (Point& p : waved) {
      const double factor = 1 + 1e-3 * wave(p);
      p = Point(p.x() * factor, p.y() * factor, p.z());
    }
    const TriangleMesh smooth = low_pass(mesh, Length::absolute(scale));
    const TriangleMesh filtered = low_pass(mesh.with_positions(waved), Length::absolute(scale));
    double along = 0;
    double total = 0;
    const double middle = mesh.bounding_box().max.z() / 2 + mesh.bounding_box().min.z() / 2;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Point& p = mesh.position(v);
      if (std::abs(p.z() - middle) > 1.01 * length) continue;  // away from the boundaries
      along += wave(p) * (radius(filtered, v) - radius(smooth, v));
      total += wave(p) * wave(p) * 1e-3;
    }
    CHECK(along / total == Approx(std::exp2(-std::pow(ratio, 4))).margin(0.03));
  }
}

TEST_CASE("even triangles keep their curvature at a scale") {
  const TriangleMesh mesh = cylinder(1, 64, 60).mesh();
  const ScalarField at_scale = curvature_at(mesh, "2edges");
  const double middle = (mesh.bounding_box().max.z() + mesh.bounding_box().min.z()) / 2;
  const double reach = 15 * core::mean_edge_length(mesh);  // the boundaries are 26 edges away
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (std::abs(mesh.position(v).z() - middle) < reach)
      CHECK(at_scale.value(v) == Approx(0.5).epsilon(0.01));
}

TEST_CASE("a sphere keeps its curvature at a scale, and a noisy one gets it back") {
  const TriangleMesh mesh = sphere(4).mesh();
  // At the 12 vertices with five neighbours, and next to them, the mean over neighbours sees the triangles.
  std::vector<bool> even(mesh.vertex_count(), true);
  std::vector<Index> ring;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    mesh.neighbors(v, ring);
    if (ring.size() == 6) continue;
    even[v] = false;
    for (const Index x : ring) even[x] = false;
  }
  REQUIRE(std::ranges::count(even, false) == 12 * 6);
  const auto worst = [&](const ScalarField& field) {
    double most = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (even[v]) most = std::max(most, std::abs(field.value(v) - 1));
    return most;
  };
  CHECK(worst(curvature_at(mesh, "2edges")) < 0.1);
  const TriangleMesh noisy = jittered(mesh, 0.01, 5);
  CHECK(worst(morse::mean_curvature(noisy)) > 2);
  CHECK(worst(curvature_at(noisy, "2edges")) < 0.3);
}

TEST_CASE("a plane stays in its plane and boundaries do not depend on the interior") {
  const TriangleMesh plane = jittered(grid(12, 9).mesh(), 0, 1);
  const TriangleMesh flat = low_pass(plane, Length::edges(1.5));
  for (Index v = 0; v < plane.vertex_count(); ++v) CHECK(flat.position(v).z() == 0);
  const ScalarField bent = curvature_at(plane, "1.5edges");
  for (const double value : bent.values()) CHECK(std::abs(value) < 1e-12);
  std::vector<Point> inside = positions_of(plane);
  for (Index v = 0; v < plane.vertex_count(); ++v)
    if (!plane.is_boundary_vertex(v)) inside[v].z() += std::sin(v * 1.7);
  // The scale in the unit of the mesh: edges get longer.
  const double scale = 1.5 * core::mean_edge_length(plane);
  const double same_steps = 1.5 * core::mean_edge_length(plane.with_positions(inside));
  const TriangleMesh a = low_pass(plane, Length::absolute(scale));
  const TriangleMesh b = low_pass(plane.with_positions(inside), Length::absolute(same_steps));
  for (Index v = 0; v < plane.vertex_count(); ++v)
    if (plane.is_boundary_vertex(v)) CHECK((a.position(v) - b.position(v)).norm() < 1e-12);
}

TEST_CASE("scale 0 is the surface as it is, and what is no scale is refused") {
  const TriangleMesh mesh = jittered(torus(20, 15).mesh(), 0.05, 3);
  CHECK(low_pass(mesh, Length::edges(0)).is_same(mesh));
  CHECK(values_of(curvature_at(mesh, "0")) == values_of(morse::mean_curvature(mesh)));
  CHECK(largest_distance(low_pass(mesh, Length::edges(1e-5)), positions_of(mesh)) < 1e-8);
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  CHECK(low_pass(point, Length::epsilons(8)).is_same(point));
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    CHECK_THROWS_AS(low_pass(mesh, Length::edges(bad)), core::InvalidArgument);
  CHECK_THROWS_AS(low_pass(mesh, Length::epsilons(334)), core::BadInput);
  CHECK_THROWS_WITH(low_pass(mesh, Length::edges(1e9)),
                    Catch::Contains("1e+09edges comes to") && Catch::Contains("diagonal"));
}

TEST_CASE("the filter moves, turns, scales and renumbers with the surface") {
  const TriangleMesh mesh = jittered(torus(24, 17).mesh(), 0.05, 5);
  const TriangleMesh filtered = low_pass(mesh, Length::edges(1.3));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  const TriangleMesh turned = low_pass(moved(mesh, 3 * turn, {7, -4, 2}), Length::edges(1.3));
  CHECK(largest_distance(turned, positions_of(moved(filtered, 3 * turn, {7, -4, 2}))) < 1e-11);
  for (const double factor : {0x1p-300, 0x1p-30, 0x1p40, 0x1p300})
    CHECK(positions_of(low_pass(scaled(mesh, factor), Length::edges(1.3))) ==
          positions_of(scaled(low_pass(mesh, Length::edges(1.3)), factor)));
  const auto n = static_cast<Index>(mesh.vertex_count());
  const auto renumbered = [&](Index v) { return (v * 7 + 3) % n; };
  REQUIRE(std::gcd(7U, n) == 1);
  std::vector<Point> positions(n);
  std::vector<core::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Index v = 0; v < n; ++v) positions[renumbered(v)] = mesh.position(v);
  for (core::Triangle& t : triangles)
    for (Index& v : t) v = renumbered(v);
  const TriangleMesh other = low_pass(Soup{positions, triangles}.mesh(), Length::edges(1.3));
  for (Index v = 0; v < n; ++v) CHECK((other.position(renumbered(v)) - filtered.position(v)).norm() < 1e-12);
}

TEST_CASE("the filter gives the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(5).mesh(), 0.01, 5);
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return positions_of(low_pass(mesh, Length::edges(2)));
  };
  CHECK(run(1) == run(4));
}

TEST_CASE("every curvature at a scale is that of the smoothed surface, and reports the scale") {
  const TriangleMesh mesh = jittered(torus(20, 15).mesh(), 0.05, 3);
  const TriangleMesh smooth = low_pass(mesh, Length::edges(1.5));
  const auto check = [&](auto make, const char* name, Given given) {
    INFO(name);
    const core::FunctionResult plain = made(make, name, given)->evaluate(smooth, {});
    given.emplace_back("scale", "1.5edges");
    const core::FunctionResult at_scale = made(make, name, given)->evaluate(mesh, {});
    CHECK(values_of(at_scale.field) == values_of(plain.field));
    CHECK(at_scale.field.mesh().is_same(mesh));
    const core::Parameters::value_type scale{"scale", 1.5 * core::mean_edge_length(mesh)};
    CHECK(std::ranges::count(at_scale.parameters, scale) == 1);
  };
  check(morse::make_mean_curvature, "mean-curvature", {});
  check(morse::make_mean_curvature, "mean-curvature", {{"estimator", "cotangent"}});
  check(morse::make_mean_curvature, "mean-curvature", {{"estimator", "quadric"}, {"radius", "1"}});
  check(morse::make_gaussian_curvature, "gaussian-curvature", {});
  check(morse::make_principal_curvature, "principal-curvature", {{"which", "min"}, {"radius", "1"}});
  check(morse::make_curvedness, "curvedness", {{"radius", "1"}});
  check(morse::make_shape_index, "shape-index", {{"estimator", "taubin"}});
}

TEST_CASE("salient with a scale smooths the function of the smoothed surface") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 5);
  const ScalarField field = morse::mean_curvature(mesh);
  const auto apply = [&](Given given, const core::MethodContext& context) {
    return made(morse::make_salient, "salient", std::move(given))->apply(field, context);
  };
  const core::MethodContext context = with_mean_curvature();
  const core::MethodResult result = apply({{"scale", "1edges"}, {"iterations", "3"}}, context);
  const ScalarField at_scale = curvature_at(mesh, "1edges");
  CHECK(values_of(result.field) == values_of(morse::salient(at_scale, {.iterations = 3}).field));
  CHECK(result.field.mesh().is_same(mesh));
  CHECK(values_of(apply({{"scale", "1edges"}, {"iterations", "0"}}, context).field) == values_of(at_scale));
  CHECK_THROWS_WITH(apply({{"scale", "1edges"}}, {}), Catch::Contains("salient with a scale"));
  CHECK_THROWS_AS(apply({{"scale", "1e6edges"}}, context), core::BadInput);
  CHECK(made(morse::make_salient, "salient", {{"scale", "1eps"}})->traits().reevaluates_function);
  CHECK(made(morse::make_salient, "salient", {{"preset", "robust"}})->traits().reevaluates_function);
  CHECK_FALSE(made(morse::make_salient, "salient", {{"preset", "robust"}, {"scale", "0"}})
                  ->traits()
                  .reevaluates_function);
  CHECK_FALSE(made(morse::make_salient, "salient")->traits().reevaluates_function);

  // Observers get the field of the smoothed surface as iteration 0; records begin with it.
  core::MethodContext listening = context;
  std::vector<int> heard;
  listening.count_iterations = true;
  listening.on_iteration = [&](int number, const ScalarField& passed) {
    heard.push_back(number);
    if (number == 0) CHECK(values_of(passed) == values_of(at_scale));
    return true;
  };
  const core::MethodResult counted = apply({{"scale", "1edges"}, {"iterations", "2"}}, listening);
  CHECK(heard == std::vector<int>{0, 1, 2});
  CHECK(counted.iterations.front().total() == morse::classify(at_scale).total());
  listening.on_iteration = [&](int, const ScalarField&) { return false; };
  CHECK(values_of(apply({{"scale", "1edges"}}, listening).field) == values_of(at_scale));
}

TEST_CASE("explicit keys override a preset, and the report has the resolved values") {
  const TriangleMesh mesh = jittered(sphere(4).mesh(), 0.01, 5);
  const ScalarField field = morse::mean_curvature(mesh);
  const auto parameter = [&](const Given& given, const char* name) {
    const core::MethodResult result =
        made(morse::make_salient, "salient", given)->apply(field, with_mean_curvature());
    const auto found =
        std::ranges::find_if(result.parameters, [&](const auto& p) { return p.first == name; });
    return found == result.parameters.end() ? core::ParameterValue(false) : found->second;
  };
  CHECK(parameter({{"preset", "robust"}}, "preset") == core::ParameterValue("robust"));
  CHECK(std::get<double>(parameter({{"preset", "robust"}}, "scale")) > 0);
  CHECK(parameter({{"preset", "robust"}, {"iterations", "1"}}, "iterations") ==
        core::ParameterValue(std::int64_t{1}));
  CHECK(parameter({{"preset", "robust"}, {"sigma", "0.25"}}, "sigma") == core::ParameterValue(0.25));
  CHECK(parameter({{"preset", "robust"}, {"scale", "0.25"}}, "scale") == core::ParameterValue(0.25));
  CHECK(parameter({{"preset", "paper"}}, "scale") == core::ParameterValue(false));
  CHECK(parameter({{"preset", "paper"}}, "iterations") == parameter({}, "iterations"));
}

TEST_CASE("counts of a sample's curvature at a scale") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  const auto total = [&](const char* scale) { return morse::classify(curvature_at(mesh, scale)).total(); };
  CHECK(total("0") == 1895);
  // Shallow ones depend on the triangulation.
  CHECK(total("1edges") == 2041);
  CHECK(total("2edges") == 2222);
}
