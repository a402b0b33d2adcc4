#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/chosen_points.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature_functions.h"
#include "morsel/morse/functions/diffused_curvature.h"
#include "morsel/morse/functions/discrete_curvature.h"
#include "morsel/morse/operators/intrinsic_triangles.h"
#include "morsel/morse/operators/laplacian.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::diffused_gaussian_curvature;
using std::numbers::pi;

namespace {

/// The formula with dense matrices and the mesh's own triangles.
std::vector<double> by_dense_matrices(const TriangleMesh& mesh, double fairing, double spread) {
  const Eigen::MatrixXd stiffness =
      morse::laplacian(mesh, morse::edge_weights(mesh, morse::EdgeWeights::cotangent));
  const std::vector<double> areas = morse::vertex_areas(mesh, morse::VertexArea::barycentric);
  const auto n = static_cast<Eigen::Index>(areas.size());
  const Eigen::MatrixXd mass = Eigen::Map<const Eigen::VectorXd>(areas.data(), n).asDiagonal();
  Eigen::MatrixXd x(n, 3);
  for (Eigen::Index v = 0; v < n; ++v) x.row(v) = mesh.position(static_cast<Index>(v)).transpose();
  const Eigen::MatrixXd step = mass + (std::sqrt(2.0) - 1) * fairing * fairing * stiffness;
  for (int pass = 0; pass < 2; ++pass) x = step.fullPivLu().solve((mass * x).eval()).eval();
  std::vector<Point> positions(areas.size());
  for (Eigen::Index v = 0; v < n; ++v) positions[static_cast<std::size_t>(v)] = x.row(v).transpose();
  std::vector<double> defects = morse::angle_defects(mesh.with_positions(std::move(positions)));
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_boundary_vertex(v)) defects[v] = 0;
  const Eigen::VectorXd k = (mass + spread * spread / 2 * stiffness)
                                .fullPivLu()
                                .solve(Eigen::Map<const Eigen::VectorXd>(defects.data(), n));
  return {k.data(), k.data() + n};
}

/// With the areas of the triangulation that the curvature is spread on.
double integral(const ScalarField& field) {
  const morse::EdgeLengths lengths = morse::edge_lengths(field.mesh());
  const std::vector<double> areas =
      morse::barycentric_areas(morse::delaunay_triangles(field.mesh(), lengths), field.mesh().vertex_count());
  double sum = 0;
  for (Index v = 0; v < field.mesh().vertex_count(); ++v)
    sum += areas[v] * lengths.unit * lengths.unit * field.value(v);
  return sum;
}

}  // namespace

TEST_CASE("diffused Gaussian curvature agrees with a direct solve") {
  for (const TriangleMesh& mesh : {jittered(sphere(2).mesh(), 0.02, 3), cylinder(1, 12, 9).mesh(),
                                   together(sphere(1), octahedron()).mesh()}) {
    REQUIRE(morse::delaunay_triangles(mesh, morse::edge_lengths(mesh)).flips == 0);
    for (const auto& [fairing, spread] : {std::pair(0.0, 0.3), {0.1, 0.5}, {0.3, 3.0}}) {
      const std::vector<double> expected = by_dense_matrices(mesh, fairing, spread);
      const ScalarField found = diffused_gaussian_curvature(mesh, fairing, spread);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        CHECK(found.value(v) == Approx(expected[v]).epsilon(1e-9).margin(1e-10));
    }
  }
}

TEST_CASE("diffused Gaussian curvature of spheres and planes, and its integral") {
  const double radius = 2.5;
  const TriangleMesh ball = scaled(sphere(4).mesh(), radius);
  const ScalarField field = diffused_gaussian_curvature(ball, 0.2, 1);
  CHECK(field.min() == Approx(1 / (radius * radius)).epsilon(0.01));
  CHECK(field.max() == Approx(1 / (radius * radius)).epsilon(0.01));
  for (const double value : values_of(diffused_gaussian_curvature(grid(9, 8).mesh(), 0.5, 2)))
    CHECK(value == Approx(0).margin(1e-12));  // its corners turn and do not bend
  for (const Soup& soup : {torus(20, 12), pierced_slab(2), together(sphere(2), torus(12, 9))}) {
    const TriangleMesh mesh = soup.mesh();
    CHECK(integral(diffused_gaussian_curvature(mesh, 0.1, 2)) ==
          Approx(2 * pi * static_cast<double>(mesh.euler_characteristic())).margin(1e-8));
  }
}

TEST_CASE("the chosen maxima of diffused Gaussian curvature are a body's tips") {
  const std::vector<Point> tips = {Point(1, 0, 0), Point(0, 1, 0), Point(0, -0.6, 0.8), Point(-0.8, 0, -0.6)};
  for (const double noise : {0.0, 0.01}) {
    const TriangleMesh mesh = jittered(with_tips(tips), noise, 3);
    const double diagonal = mesh.bounding_box().diagonal();
    const ScalarField field = diffused_gaussian_curvature(mesh, 0.02 * diagonal, 0.2 * diagonal);
    const std::vector<std::vector<morse::PointCandidate>> maxima = {
        morse::point_candidates(field, morse::PointKind::maxima)};
    const morse::ChosenPoints marks = morse::choose_points(mesh, maxima, tips.size(), 0.05 * diagonal);
    REQUIRE(marks.points.size() == tips.size());
    for (const Point& tip : tips) {
      double nearest = HUGE_VAL;
      for (const morse::ChosenPoint& mark : marks.points)
        nearest = std::min(nearest, (mesh.position(mark.candidate.point.vertex) - 1.5 * tip).norm());
      CHECK(nearest < 0.05 * diagonal);
    }
  }
}

TEST_CASE("diffused Gaussian curvature scales exactly and is the same for every number of threads") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.03, 4);
  const ScalarField field = diffused_gaussian_curvature(mesh, 0.1, 0.6);
  for (const int exponent : {40, -300}) {
    const ScalarField other = diffused_gaussian_curvature(
        scaled(mesh, std::ldexp(1, exponent)), std::ldexp(0.1, exponent), std::ldexp(0.6, exponent));
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(std::ldexp(other.value(v), 2 * exponent) == field.value(v));
  }
  const auto run = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return values_of(diffused_gaussian_curvature(mesh, 0.1, 0.6));
  };
  CHECK(run(1) == run(4));
}

TEST_CASE("diffused Gaussian curvature by name") {
  const TriangleMesh mesh = jittered(sphere(3).mesh(), 0.02, 5);
  const double diagonal = mesh.bounding_box().diagonal();
  const auto make = [](Given given) {
    given.emplace_back("estimator", "diffused");
    return made(morse::make_gaussian_curvature, "gaussian-curvature", std::move(given));
  };
  const core::FunctionResult found = make({})->evaluate(mesh, {});
  CHECK(found.parameters == core::Parameters{{"estimator", "diffused"},
                                             {"fairing", 0.8 / 100 * diagonal},
                                             {"spread", 20.0 / 100 * diagonal}});
  CHECK(values_of(found.field) ==
        values_of(diffused_gaussian_curvature(mesh, 0.8 / 100 * diagonal, 20.0 / 100 * diagonal)));
  CHECK_NOTHROW(make({{"fairing", "0"}})->evaluate(mesh, {}));
  CHECK_THROWS_AS(make({{"spread", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(make({{"fairing", "-1%"}}), core::InvalidArgument);
  CHECK_THROWS_WITH(make({{"spread", "101%"}})->evaluate(mesh, {}), Catch::Contains("diagonal"));
  CHECK_THROWS_WITH(make({{"fairing", "101%"}})->evaluate(mesh, {}), Catch::Contains("fairing"));
  CHECK_THROWS_WITH(make({{"radius", "8eps"}}), Catch::Contains("quadric"));
  for (const char* key : {"fairing", "spread"})
    CHECK_THROWS_WITH(made(morse::make_gaussian_curvature, "gaussian-curvature", {{key, "5%"}}),
                      Catch::Contains(key) && Catch::Contains("estimator=diffused"));
  CHECK_THROWS_AS(made(morse::make_mean_curvature, "mean-curvature", {{"spread", "5%"}}),
                  core::InvalidArgument);
}

TEST_CASE("diffused Gaussian curvature of every kind of mesh has values, and bad lengths are refused") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    const double diagonal = entry.mesh.bounding_box().diagonal();
    const ScalarField field = diffused_gaussian_curvature(entry.mesh, 0.01 * diagonal, 0.2 * diagonal);
    const morse::CriticalPoints points = morse::classify(field);
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          entry.mesh.euler_characteristic());
  }
  const TriangleMesh mesh = sphere(2).mesh();
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    CHECK_THROWS_AS(diffused_gaussian_curvature(mesh, bad, 1), core::InvalidArgument);
    CHECK_THROWS_AS(diffused_gaussian_curvature(mesh, 1, bad), core::InvalidArgument);
  }
  CHECK_THROWS_AS(diffused_gaussian_curvature(mesh, 1, 0), core::InvalidArgument);
  const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
  CHECK_THROWS_AS(diffused_gaussian_curvature(point, 0, 1), core::BadInput);
}
