#include "morsel/morse/smoothing/gaussian.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/operators/laplacian.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
namespace {

core::MethodResult apply_gaussian(const ScalarField& field, Given given) {
  return made(morse::make_gaussian, "gaussian", std::move(given))->apply(field, {});
}

/// Equation (1), over all pairs; with `counts` points count so often.
std::vector<double> slow_average(const ScalarField& field, double sigma, double support,
                                 const std::vector<double>& counts = {}) {
  std::vector<double> result;
  for (const Point& p : field.mesh().positions()) {
    double numerator = 0;
    double denominator = 0;
    for (Index x = 0; x < field.mesh().vertex_count(); ++x) {
      const double distance = (field.mesh().position(x) - p).norm();
      if (distance > support * sigma) continue;
      const double weight =
          std::exp(-distance * distance / (2 * sigma * sigma)) * (counts.empty() ? 1 : counts[x]);
      numerator += weight * field.value(x);
      denominator += weight;
    }
    result.push_back(numerator / denominator);
  }
  return result;
}

}  // namespace

TEST_CASE("the Gaussian average is the formula") {
  // Sides 3, 4, 5 and a reach of 4.
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const ScalarField result = apply_gaussian({mesh, {1, 2, 5}}, {{"sigma", "2"}}).field;
  const double w1 = std::exp(-9.0 / 8);
  const double w2 = std::exp(-2.0);
  CHECK(result.value(0) == Approx((1 + 2 * w1 + 5 * w2) / (1 + w1 + w2)).epsilon(1e-15));
  CHECK(result.value(1) == Approx((2 + w1) / (1 + w1)).epsilon(1e-15));
  CHECK(result.value(2) == Approx((5 + w2) / (1 + w2)).epsilon(1e-15));
}

TEST_CASE("the Gaussian average agrees with the sum over all pairs") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    if (entry.mesh.vertex_count() > 700) continue;
    const TriangleMesh mesh = jittered(entry.mesh, 0.02, 3);
    const double sigma = 0.07 * mesh.bounding_box().diagonal();
    for (const double unit : {1.0, 1e-200, 1e200}) {
      std::vector<double> values = random_values(mesh.vertex_count(), 7);
      for (double& value : values) value = unit * (value - 0.5);
      const ScalarField field(mesh, values);
      const std::vector<double> expected = slow_average(field, sigma, 1.5);
      morse::GaussianOptions options;
      options.sigma = core::Length::absolute(sigma);
      options.support = 1.5;
      const ScalarField result = morse::gaussian(field, options);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        CHECK(result.value(v) / unit == Approx(expected[v] / unit).margin(1e-13));
      options.weights = morse::NeighborWeights::area;
      const std::vector<double> by_area =
          slow_average(field, sigma, 1.5, vertex_areas(mesh, morse::VertexArea::mixed));
      const ScalarField weighted = morse::gaussian(field, options);
      for (Index v = 0; v < mesh.vertex_count(); ++v)
        CHECK(weighted.value(v) / unit == Approx(by_area[v] / unit).margin(1e-13));
    }
  }
}

TEST_CASE("Gaussian averages keep constants and stay within the extremes") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& named : field_zoo(entry.mesh, 3)) {
      INFO(entry.name << ", " << named.name);
      const core::MethodResult result =
          apply_gaussian(named.field, {{"iterations", "3"}, {"sigma", "40eps"}});
      const double margin = 1e-12 * (1 + std::abs(named.field.max()));
      CHECK(result.field.min() >= named.field.min() - margin);
      CHECK(result.field.max() <= named.field.max() + margin);
      const morse::CriticalPoints points = morse::classify(result.field);
      CHECK(static_cast<long>(points.minima + points.maxima) -
                static_cast<long>(points.saddle_multiplicity) ==
            entry.mesh.euler_characteristic());
    }
}

TEST_CASE("the Gaussian method resolves its keys and obeys its stop conditions") {
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 3));
  const core::MethodResult result = apply_gaussian(field, {});
  CHECK(result.parameters == core::Parameters{{"iterations", std::int64_t{1}},
                                              {"sigma", 8 * mesh.epsilon()},
                                              {"support", 2.0},
                                              {"weights", "none"},
                                              {"ball", "euclidean"}});
  CHECK(values_of(result.field) == values_of(morse::gaussian(field)));
  const core::MethodResult counted = apply_gaussian(field, {{"until-count", "20"}, {"sigma", "0.2"}});
  CHECK(counted.iterations.back().total() <= 20);
  CHECK(counted.iterations.size() > 2);
  CHECK(morse::classify(counted.field).total() == counted.iterations.back().total());
  CHECK(values_of(apply_gaussian(field, {{"iterations", "0"}}).field) == values_of(field));
  const Given connected = {{"sigma", "0.2"}, {"weights", "area"}, {"ball", "connected"}};
  CHECK(values_of(apply_gaussian(field, connected).field) !=
        values_of(apply_gaussian(field, {{"sigma", "0.2"}}).field));
}

TEST_CASE("the Gaussian method refuses what is out of range") {
  const ScalarField field(octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3});
  const Given bad = {{"sigma", "0"},    {"sigma", "-1eps"}, {"sigma", "inf"}, {"support", "0"},
                     {"range", "1std"}, {"ball", "flat"},   {"weights", "1"}, {"iterations", "-1"}};
  for (const auto& [key, value] : bad) {
    INFO(key << "=" << value);
    CHECK_THROWS_AS(apply_gaussian(field, {{key, value}}), core::InvalidArgument);
    CHECK_THROWS_WITH(apply_gaussian(field, {{key, value}}),
                      Catch::Contains("gaussian") && Catch::Contains(key));
  }
}

TEST_CASE("counts of Gaussian averages on the samples") {
  const auto total = [](const char* file, Given given) {
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    return morse::classify(apply_gaussian(field, std::move(given)).field).total();
  };
  CHECK(total("lion-head.off", {}) == 360);
  CHECK(total("lion-head.off", {{"iterations", "5"}}) == 73);
  CHECK(total("bunny00.off", {}) == 457);
}
