#include "morsel/morse/functions/diffused_curvature.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/subdivision.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/curvature_functions.h"
#include "morsel/morse/operators/intrinsic_triangles.h"
#include "morsel/morse/operators/low_pass.h"
#include "morsel/morse/operators/normals.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::diffused_mean_curvature;

namespace {

/// What is left of a wave of frequency k (the eigenvalue of the Laplacian).
double kept(double k, double scale) { return std::pow(1 + (std::sqrt(2.0) - 1) * scale * scale * k, -2); }

/// Points of a sphere with triangles of all shapes.
TriangleMesh uneven_sphere(double amount) {
  const TriangleMesh rough = jittered(sphere(4).mesh(), amount, 7);
  std::vector<Point> positions;
  for (const Point& p : rough.positions()) positions.push_back(p.normalized());
  return rough.with_positions(std::move(positions));
}

double spread(const ScalarField& field) { return field.extent() / std::abs(field.max() + field.min()) * 2; }

/// The formula with dense matrices and the mesh's own triangles.
std::vector<double> by_dense_matrices(const TriangleMesh& mesh, double scale) {
  const Eigen::MatrixXd stiffness =
      morse::laplacian(mesh, morse::edge_weights(mesh, morse::EdgeWeights::cotangent));
  const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::barycentric);
  const auto n = static_cast<Eigen::Index>(areas.size());
  const Eigen::MatrixXd delta =
      Eigen::Map<const Eigen::VectorXd>(areas.data(), n).cwiseInverse().asDiagonal() * stiffness;
  const auto step = [&](double s) -> Eigen::MatrixXd {
    return (Eigen::MatrixXd::Identity(n, n) + (std::sqrt(2.0) - 1) * s * s * delta).inverse();
  };
  Eigen::MatrixXd x(n, 3);
  for (Eigen::Index v = 0; v < n; ++v) x.row(v) = mesh.position(static_cast<Index>(v)).transpose();
  x = (step(scale) * (step(scale) * x)).eval();
  std::vector<Point> positions(areas.size());
  for (Eigen::Index v = 0; v < n; ++v) positions[static_cast<std::size_t>(v)] = x.row(v).transpose();
  const std::vector<Point> normals = morse::vertex_normals(mesh.with_positions(std::move(positions)));
  const Eigen::MatrixXd bends = delta * x;
  Eigen::VectorXd h(n);
  for (Eigen::Index v = 0; v < n; ++v)
    h[v] = bends.row(v).dot(normals[static_cast<std::size_t>(v)].transpose()) / 2;
  h = (step(scale / 3) * (step(scale / 3) * h)).eval();
  return {h.data(), h.data() + n};
}

}  // namespace

TEST_CASE("diffused curvature of a sphere, whatever its triangles") {
  for (const double scale : {0.1, 0.3, 1.0}) {
    const double expected = kept(2, scale);  // coordinates are waves of frequency 2/r²
    for (const TriangleMesh& mesh : {sphere(4).mesh(), inside_out(sphere(4)).mesh()}) {
      const ScalarField field = diffused_mean_curvature(mesh, scale);
      CHECK(field.min() == Approx(expected).epsilon(0.01));
      CHECK(field.max() == Approx(expected).epsilon(0.01));
    }
  }
  const TriangleMesh uneven = uneven_sphere(0.03);
  CHECK(spread(morse::mean_curvature(uneven)) > 0.1);
  CHECK(spread(diffused_mean_curvature(uneven, 0.3)) < 0.03);
}

TEST_CASE("diffused curvature of planes, cylinders and their boundaries") {
  for (const double value : values_of(diffused_mean_curvature(grid(9, 8).mesh(), 2)))
    CHECK(value == Approx(0).margin(1e-12));
  const double radius = 2.5;
  const double scale = 0.8;
  constexpr int kAround = 60;
  constexpr int kRows = 20;
  const ScalarField tube = diffused_mean_curvature(cylinder(radius, kAround, kRows).mesh(), scale);
  const double expected = kept(1 / (radius * radius), scale) / (2 * radius);
  for (Index v = 0; v < kAround * kRows; ++v)  // at the ends normals lean a little
    CHECK(tube.value(v) ==
          Approx(expected).epsilon(v < 4 * kAround || v >= kAround * (kRows - 4) ? 0.05 : 0.01));
}

TEST_CASE("waves of 2 pi times the scale keep nearly half of their curvature") {
  // Ripples around a cylinder, low enough to be waves of the cylinder: the field's own are k h/2 high.
  constexpr int kAround = 96;
  const TriangleMesh mesh = cylinder(1, kAround, 40).mesh();
  const int waves = 12;
  const double height = 1e-4;
  std::vector<Point> rippled;
  for (const Point& p : mesh.positions()) {
    const double angle = std::atan2(p.y(), p.x());
    const double r = 1 + height * std::cos(waves * angle);
    rippled.emplace_back(p.x() * r, p.y() * r, p.z());
  }
  const double frequency = waves * waves;
  const double scale = 1.0 / waves;
  const auto extent = [&](const ScalarField& field) { return field.extent(); };
  const double found = extent(diffused_mean_curvature(mesh.with_positions(std::move(rippled)), scale)) -
                       extent(diffused_mean_curvature(mesh, scale));
  // Half is left of (k − 1/r²) · height / 2, from crest to trough twice that; then a third of the scale takes
  // a little.
  CHECK(found ==
        Approx((frequency - 1) * height * kept(frequency, scale) * kept(frequency, scale / 3)).epsilon(0.05));
  CHECK(kept(frequency, scale) == Approx(0.5));
}

TEST_CASE("diffused curvature agrees with dense matrices") {
  for (const TriangleMesh& mesh : {jittered(sphere(2).mesh(), 0.02, 3), cylinder(1, 12, 9).mesh(),
                                   together(sphere(1), octahedron()).mesh()}) {
    REQUIRE(morse::delaunay_triangles(mesh, morse::edge_lengths(mesh)).flips == 0);
    for (const double scale : {0.05, 0.4}) {
      const std::vector<double> expected = by_dense_matrices(mesh, scale);
      const std::vector<double> found = values_of(diffused_mean_curvature(mesh, scale));
      for (std::size_t v = 0; v < expected.size(); ++v)
        CHECK(found[v] == Approx(expected[v]).epsilon(1e-9).margin(1e-10));
    }
  }
}

TEST_CASE("diffused curvature depends on neither subdivision nor numbering nor motions") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.03, 4);
  const double scale = 0.4;
  const ScalarField field = diffused_mean_curvature(mesh, scale);
  const ScalarField finer = diffused_mean_curvature(core::subdivided(mesh, 3), scale);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(finer.value(v) == Approx(field.value(v)).margin(0.2 * field.extent()));

  const double angle = 0.7;
  Eigen::Matrix3d turn;
  turn << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  const ScalarField turned = diffused_mean_curvature(moved(mesh, turn, Point(3, -2, 5)), scale);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(turned.value(v) == Approx(field.value(v)).epsilon(1e-8));
  const ScalarField large = diffused_mean_curvature(scaled(mesh, std::ldexp(1, 40)), std::ldexp(scale, 40));
  const ScalarField small =
      diffused_mean_curvature(scaled(mesh, std::ldexp(1, -400)), std::ldexp(scale, -400));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(std::ldexp(large.value(v), 40) == field.value(v));
    CHECK(std::ldexp(small.value(v), -400) == field.value(v));
  }
  Soup soup{{mesh.positions().begin(), mesh.positions().end()},
            {mesh.triangles().begin(), mesh.triangles().end()}};
  std::vector<Index> number;
  const ScalarField renumbered = diffused_mean_curvature(shuffled(soup, 5, &number).mesh(), scale);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(renumbered.value(number[v]) == Approx(field.value(v)).epsilon(1e-8));
}

TEST_CASE("diffused curvature gives the same bits for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(5).mesh(), 0.01, 5);
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return values_of(diffused_mean_curvature(mesh, 0.2));
  };
  CHECK(run(1) == run(4));
}

TEST_CASE("diffused curvature of every kind of mesh has values") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const double scale = 0.1 * entry.mesh.bounding_box().diagonal();
    const morse::CriticalPoints points = morse::classify(diffused_mean_curvature(entry.mesh, scale));
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          entry.mesh.euler_characteristic());
  }
  // A triangle without an area is allowed.
  std::vector<Point> positions(sphere(3).positions);
  positions[1] = positions[sphere(3).triangles[0][0] == 1 ? 2 : sphere(3).triangles[0][0]];
  const ScalarField field = diffused_mean_curvature(sphere(3).mesh().with_positions(positions), 0.5);
  CHECK(std::isfinite(field.extent()));
}

TEST_CASE("diffused curvature refuses invalid scales") {
  const TriangleMesh mesh = sphere(2).mesh();
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THROWS_AS(diffused_mean_curvature(mesh, scale), core::InvalidArgument);
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  CHECK_THROWS_AS(diffused_mean_curvature(point, 1), core::BadInput);
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(diffused_mean_curvature(mesh, 1, core::Progress({}, stop.get_token())), core::Cancelled);
}

TEST_CASE("estimator=diffused smooths noise away before and says so") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.02, 5);
  const auto evaluate = [&](const TriangleMesh& on, Given given) {
    given.emplace_back("estimator", "diffused");
    return made(morse::make_mean_curvature, "mean-curvature", given)->evaluate(on, {});
  };
  const double scale = 0.6 * core::mean_edge_length(mesh);
  const double diffusion = 0.036 * core::root_area(mesh);
  const core::FunctionResult found = evaluate(mesh, {});
  CHECK(found.parameters ==
        core::Parameters{{"estimator", "diffused"}, {"scale", scale}, {"diffusion", diffusion}});
  CHECK(values_of(found.field) ==
        values_of(diffused_mean_curvature(morse::low_pass(mesh, core::Length::edges(0.6)), diffusion)));
  CHECK(values_of(evaluate(mesh, {{"scale", "0"}, {"diffusion", "0.25"}}).field) ==
        values_of(diffused_mean_curvature(mesh, 0.25)));
  CHECK_THROWS_WITH(evaluate(mesh, {{"radius", "8eps"}}),
                    Catch::Contains("radius") && Catch::Contains("quadric"));
  CHECK_THROWS_AS(evaluate(mesh, {{"diffusion", "0"}}), core::InvalidArgument);
  CHECK_THROWS_WITH(evaluate(mesh, {{"diffusion", "400eps"}}), Catch::Contains("diagonal"));
  CHECK_THROWS_WITH(made(morse::make_mean_curvature, "mean-curvature", {{"diffusion", "8eps"}}),
                    Catch::Contains("estimator=diffused"));
  CHECK_THROWS_AS(made(morse::make_shape_index, "shape-index", {{"estimator", "diffused"}}),
                  core::InvalidArgument);
}

TEST_CASE("counts of a sample's diffused curvature") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  const auto total = [&](const char* diffusion) {
    return morse::classify(made(morse::make_mean_curvature, "mean-curvature",
                                {{"estimator", "diffused"}, {"diffusion", diffusion}})
                               ->evaluate(mesh, {})
                               .field)
        .total();
  };
  CHECK(total("3eps") == 546);
  CHECK(total("12eps") == 103);
}
