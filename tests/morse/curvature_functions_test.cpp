#include "morsel/morse/functions/curvature_functions.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/discrete_curvature.h"
#include "morsel/morse/functions/quadric_curvature.h"
#include "support/made.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {
using Make = std::unique_ptr<core::MorseFunction> (*)(core::ParameterReader&);

const std::map<std::string, Make> kFunctions = {{"mean-curvature", morse::make_mean_curvature},
                                                {"gaussian-curvature", morse::make_gaussian_curvature},
                                                {"principal-curvature", morse::make_principal_curvature},
                                                {"curvedness", morse::make_curvedness},
                                                {"shape-index", morse::make_shape_index}};

core::FunctionResult evaluate(const TriangleMesh& mesh, const std::string& name, Given given = {}) {
  return made(kFunctions.at(name), name, std::move(given))->evaluate(mesh, {});
}

std::size_t total(const TriangleMesh& mesh, const std::string& name, Given given = {}) {
  return morse::classify(evaluate(mesh, name, std::move(given)).field).total();
}

}  // namespace

TEST_CASE("curvature functions by name are the curvatures") {
  const TriangleMesh mesh = jittered(torus(20, 15).mesh(), 0.05, 3);
  const morse::PrincipalCurvatures k = morse::principal_curvatures(mesh);
  CHECK(values_of(evaluate(mesh, "mean-curvature").field) == values_of(morse::mean_curvature(mesh)));
  CHECK(values_of(evaluate(mesh, "mean-curvature", {{"estimator", "cotangent"}}).field) ==
        values_of(morse::cotangent_mean_curvature(mesh)));
  CHECK(values_of(evaluate(mesh, "gaussian-curvature").field) == values_of(morse::gaussian_curvature(mesh)));
  const Given taubin = {{"estimator", "taubin"}};
  CHECK(values_of(evaluate(mesh, "principal-curvature", taubin).field) == k.k1);
  CHECK(values_of(evaluate(mesh, "principal-curvature", {{"which", "min"}, {"estimator", "taubin"}}).field) ==
        k.k2);
  CHECK(values_of(evaluate(mesh, "curvedness", taubin).field) == morse::curvedness(k));
  CHECK(values_of(evaluate(mesh, "shape-index", taubin).field) == morse::shape_index(k));
  const morse::QuadricCurvatures fitted = morse::quadric_curvatures(mesh, 1.5);
  const Given quadric = {{"estimator", "quadric"}, {"radius", "1.5"}};
  const auto& [k1, k2] = fitted.curvatures;
  const core::FunctionResult mean = evaluate(mesh, "mean-curvature", quadric);
  const core::FunctionResult gauss = evaluate(mesh, "gaussian-curvature", quadric);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(mean.field.value(v) == (k1[v] + k2[v]) / 2);
    CHECK(gauss.field.value(v) == k1[v] * k2[v]);
  }
  CHECK(values_of(evaluate(mesh, "curvedness", quadric).field) == morse::curvedness(fitted.curvatures));
  CHECK(values_of(evaluate(mesh, "shape-index", quadric).field) == morse::shape_index(fitted.curvatures));
}

TEST_CASE("curvature functions report their resolved parameters") {
  const TriangleMesh mesh = sphere(3).mesh();
  CHECK(evaluate(mesh, "mean-curvature").parameters == core::Parameters{{"estimator", "taubin"}});
  CHECK(evaluate(mesh, "principal-curvature", {{"which", "min"}, {"estimator", "taubin"}}).parameters ==
        core::Parameters{{"which", "min"}, {"estimator", "taubin"}});
  CHECK(evaluate(mesh, "mean-curvature", {{"estimator", "quadric"}}).parameters ==
        core::Parameters{{"estimator", "quadric"},
                         {"radius", 0.015 * core::root_area(mesh)},
                         {"widened_vertices", std::int64_t{642}},
                         {"unfitted_vertices", std::int64_t{0}}});
}

TEST_CASE("shape index and curvedness of known shapes") {
  const double ten = 10;
  const morse::PrincipalCurvatures k = {{ten, ten, ten, 0, -ten, 0}, {ten, 0, -ten, -ten, -ten, 0}};
  const std::vector<double> index = morse::shape_index(k);
  const std::vector<double> expected = {1, 0.5, 0, -0.5, -1, 0};
  const std::vector<double> bent = morse::curvedness(k);
  const std::vector<double> strength = {10, 10 / std::sqrt(2.0), 10, 10 / std::sqrt(2.0), 10, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(index[i] == Approx(expected[i]).margin(1e-15));
    CHECK(bent[i] == Approx(strength[i]).margin(1e-15));
  }
}

TEST_CASE("shape index and curvedness on surfaces") {
  const Given quadric = {{"estimator", "quadric"}, {"radius", "0.4"}};
  const TriangleMesh ball = sphere(4).mesh();
  const Given taubin = {{"estimator", "taubin"}};
  for (const Given& given : {taubin, quadric, Given{}}) {
    const double least = given == taubin ? 0.84 : 0.97;
    CHECK(evaluate(ball, "shape-index", given).field.min() > least);
    CHECK(evaluate(ball, "curvedness", given).field.min() == Approx(1).epsilon(0.05));
    CHECK(evaluate(ball, "curvedness", given).field.max() == Approx(1).epsilon(0.05));
    CHECK(evaluate(inside_out(sphere(4)).mesh(), "shape-index", given).field.min() > least);
  }
  constexpr int kAround = 60;
  const TriangleMesh tube = cylinder(2.5, kAround, 11).mesh();
  const ScalarField index = evaluate(tube, "shape-index").field;
  const ScalarField bent = evaluate(tube, "curvedness").field;
  for (Index v = 3 * kAround; v < 8 * kAround; ++v) {
    CHECK(index.value(v) == Approx(0.5).margin(0.01));
    CHECK(bent.value(v) == Approx(0.4 / std::sqrt(2.0)).epsilon(0.02));
  }
  const ScalarField flat = evaluate(grid(6, 6).mesh(), "shape-index").field;
  CHECK(flat.min() == 0);
  CHECK(flat.max() == 0);
}

TEST_CASE("curvature functions refuse what they do not know") {
  const TriangleMesh mesh = sphere(2).mesh();
  for (const auto& [name, make] : kFunctions) {
    INFO(name);
    CHECK_THROWS_WITH(evaluate(mesh, name, {{"estimator", "fast"}}), Catch::Contains("quadric"));
    CHECK_THROWS_AS(evaluate(mesh, name, {{"estimator", "quadric"}, {"radius", "0"}}), core::InvalidArgument);
    CHECK_THROWS_AS(evaluate(mesh, name, {{"estimator", "quadric"}, {"radius", "-2eps"}}),
                    core::InvalidArgument);
    const std::string other = name == "gaussian-curvature" ? "defect" : "taubin";
    CHECK_THROWS_WITH(evaluate(mesh, name, {{"estimator", other}, {"radius", "3"}}),
                      Catch::Contains("estimator=quadric"));
    CHECK_THROWS_AS(evaluate(mesh, name, {{"width", "2"}}), core::InvalidArgument);
    const TriangleMesh point = mesh.with_positions(std::vector<Point>(mesh.vertex_count(), Point(1, 2, 3)));
    CHECK_THROWS_AS(evaluate(point, name, {{"estimator", "quadric"}}), core::BadInput);
    const bool by_quadrics = name != "mean-curvature" && name != "gaussian-curvature";
    const Given one_ring = by_quadrics ? Given{{"estimator", "taubin"}} : Given{};
    CHECK(evaluate(point, name, one_ring).field.extent() == 0);
    std::stop_source stop;
    stop.request_stop();
    core::ParameterReader reader({name, {}});
    CHECK_THROWS_AS(make(reader)->evaluate(mesh, {nullptr, core::Progress({}, stop.get_token())}),
                    core::Cancelled);
  }
  CHECK_THROWS_WITH(evaluate(mesh, "principal-curvature", {{"which", "mean"}}),
                    Catch::Contains("must be max or min"));
}

TEST_CASE("curvature functions fulfil the Euler identity") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const auto& [name, make] : kFunctions)
      for (const bool quadric : {false, true}) {
        INFO(entry.name << ", " << name);
        const Given given = quadric ? Given{{"estimator", "quadric"}} : Given{};
        const morse::CriticalPoints points = morse::classify(evaluate(entry.mesh, name, given).field);
        CHECK(static_cast<long>(points.minima + points.maxima) -
                  static_cast<long>(points.saddle_multiplicity) ==
              entry.mesh.euler_characteristic());
      }
}

TEST_CASE("counts of curvature functions on the samples") {
  const Given cotangent = {{"estimator", "cotangent"}};
  const Given quadric = {{"estimator", "quadric"}, {"radius", "5eps"}};
  const Given fitted = {{"radius", "5eps"}};
  const Given taubin = {{"estimator", "taubin"}};
  const auto row = [&](const char* file) {
    const TriangleMesh mesh = core::read_mesh(sample(file)).mesh;
    return std::vector<std::size_t>{
        total(mesh, "mean-curvature", cotangent),
        total(mesh, "mean-curvature", quadric),
        total(mesh, "gaussian-curvature"),
        total(mesh, "gaussian-curvature", quadric),
        total(mesh, "principal-curvature", taubin),
        total(mesh, "principal-curvature", {{"which", "min"}, {"estimator", "taubin"}}),
        total(mesh, "principal-curvature", fitted),
        total(mesh, "curvedness", taubin),
        total(mesh, "curvedness", fitted),
        total(mesh, "shape-index", taubin),
        total(mesh, "shape-index", fitted)};
  };
  CHECK(row("lion-head.off") ==
        std::vector<std::size_t>{1801, 1706, 2095, 1904, 2542, 2707, 1819, 2599, 1932, 2593, 2081});
  CHECK(row("bunny00.off") ==
        std::vector<std::size_t>{8950, 4154, 10546, 5303, 12689, 12628, 5151, 11823, 5466, 14408, 5960});
}
