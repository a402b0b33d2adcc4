// Curvatures under refinement, and what is said where they are none.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "morsel/morse/functions/curvature_functions.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;

namespace {

constexpr int kLevels = 3;

struct Exact {
  double k1, k2;
};

/// A surface at three levels, and the principal curvatures of the smooth one.
struct Surface {
  std::string name;
  std::function<Soup(int level)> make;
  std::function<Exact(int level, Index v)> exact;
};

const std::vector<Surface>& surfaces() {
  static const std::vector<Surface> all = {
      {"cylinder", [](int level) { return cylinder(2.5, 30 << level, 13 << level); },
       [](int, Index) {
         return Exact{1 / 2.5, 0};
       }},
      {"torus", [](int level) { return torus(40 << level, 20 << level); },
       [](int level, Index v) {
         const auto along = static_cast<Index>(20 << level);
         const double c = std::cos(2 * M_PI * (v % along) / along);
         return Exact{1, c / (2 + c)};
       }},
      {"sphere", [](int level) { return sphere(2 + level); },
       [](int, Index) {
         return Exact{1, 1};
       }}};
  return all;
}

using Make = std::unique_ptr<core::MorseFunction> (*)(core::ParameterReader&);
struct Quantity {
  std::string name;
  Make make;
  double (*of)(const Exact&);
};

double mean(const Exact& k) { return (k.k1 + k.k2) / 2; }
double product(const Exact& k) { return k.k1 * k.k2; }
double largest(const Exact& k) { return k.k1; }
double bent(const Exact& k) { return std::sqrt((k.k1 * k.k1 + k.k2 * k.k2) / 2); }
double shape(const Exact& k) { return 2 / M_PI * std::atan2(k.k1 + k.k2, k.k1 - k.k2); }

const Quantity kMean = {"mean-curvature", morse::make_mean_curvature, mean};
const Quantity kGaussian = {"gaussian-curvature", morse::make_gaussian_curvature, product};
const Quantity kPrincipal = {"principal-curvature", morse::make_principal_curvature, largest};
const Quantity kCurvedness = {"curvedness", morse::make_curvedness, bent};
const Quantity kShapeIndex = {"shape-index", morse::make_shape_index, shape};

/// The root of the mean squared error, away from boundaries.
double error_at(const Surface& surface, int level, const Quantity& quantity, const Given& given) {
  const TriangleMesh mesh = surface.make(level).mesh();
  const core::ScalarField field = made(quantity.make, quantity.name, given)->evaluate(mesh, {}).field;
  const double height = mesh.bounding_box().max.z() - mesh.bounding_box().min.z();
  const double bottom = mesh.bounding_box().min.z();
  double sum = 0;
  std::size_t count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double up = (mesh.position(v).z() - bottom) / height;
    if (!mesh.is_closed() && (up < 0.25 || up > 0.75)) continue;
    const double off = field.value(v) - quantity.of(surface.exact(level, v));
    sum += off * off;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

TEST_CASE("regression: curvatures did not converge at their defaults") {
  const Given defaults = {};
  const std::vector<std::pair<Quantity, Given>> estimates = {
      {kMean, {{"estimator", "cotangent"}}},
      {kMean, {{"estimator", "quadric"}}},
      {kMean, {{"estimator", "diffused"}, {"diffusion", "1edges"}, {"scale", "0"}}},
      {kGaussian, defaults},
      {kGaussian, {{"estimator", "quadric"}}},
      {kPrincipal, defaults},
      {kCurvedness, defaults},
      {kShapeIndex, defaults}};
  for (const Surface& surface : surfaces())
    for (const auto& [quantity, given] : estimates) {
      std::vector<double> errors;
      for (int level = 0; level < kLevels; ++level)
        errors.push_back(error_at(surface, level, quantity, given));
      INFO(quantity.name << (given.empty() ? "" : ":" + given.front().second) << " on the " << surface.name
                         << ": " << errors[0] << ", " << errors[1] << ", " << errors[2]);
      if (errors.front() < 1e-10) continue;  // flat in one direction: exact but for rounding
      for (int level = 1; level < kLevels; ++level) CHECK(errors[level] < 0.8 * errors[level - 1]);
    }
}

TEST_CASE("Taubin's curvatures do not converge, as their page says") {
  const Given taubin = {{"estimator", "taubin"}};
  const Surface& torus_surface = surfaces()[1];
  for (int level = 0; level < kLevels; ++level) {
    CHECK(error_at(torus_surface, level, kMean, {}) > 0.05);
    CHECK(error_at(torus_surface, level, kPrincipal, taubin) > 0.2);
  }
  // On a cylinder of equilateral triangles they do.
  CHECK(error_at(surfaces()[0], 2, kPrincipal, taubin) < 1e-4);
}

TEST_CASE("Gaussian curvature is at most the square of mean curvature where one estimator gives both") {
  const Given quadric = {{"estimator", "quadric"}};
  for (const TriangleMesh& mesh :
       {jittered(torus(30, 17).mesh(), 0.05, 3), jittered(sphere(3).mesh(), 0.02, 5)}) {
    const core::ScalarField h = made(kMean.make, "mean-curvature", quadric)->evaluate(mesh, {}).field;
    const core::ScalarField k = made(kGaussian.make, "gaussian-curvature", quadric)->evaluate(mesh, {}).field;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(k.value(v) <= h.value(v) * h.value(v) * (1 + 1e-14) + 1e-300);
  }
}

TEST_CASE("regression: the angle defect at a rim was passed off as a curvature") {
  const auto warnings = [](const TriangleMesh& mesh, const Given& given) {
    return made(kGaussian.make, "gaussian-curvature", given)->evaluate(mesh, {}).warnings;
  };
  REQUIRE(warnings(grid(5, 4).mesh(), {}).size() == 1);
  CHECK_THAT(warnings(grid(5, 4).mesh(), {}).front(),
             Catch::Contains("at 14 boundary vertices") && Catch::Contains("estimator=quadric"));
  CHECK(warnings(grid(5, 4).mesh(), {{"estimator", "quadric"}}).empty());
  CHECK(warnings(sphere(2).mesh(), {}).empty());
}
