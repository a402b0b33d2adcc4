#include "morsel/morse/smoothing/spectral.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/operators/eigenfunctions.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

core::MethodResult apply_spectral(const ScalarField& field, Given given) {
  return made(morse::make_spectral, "spectral", std::move(given))->apply(field, {});
}

}  // namespace

TEST_CASE("a sum of few eigenfunctions and constants is kept") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const std::size_t modes = std::min<std::size_t>(4, morse::nonconstant_eigenfunction_count(mesh));
    const auto functions = morse::eigenfunctions(mesh, modes);
    std::vector<double> f(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      f[v] = 5 + 3 * mesh.component_of_vertex(v);
      for (std::size_t k = 0; k < modes; ++k) f[v] += (2.0 - k) * functions[k].phi[v];
    }
    const morse::SpectralResult result = morse::spectral({mesh, f}, modes);
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(result.field.value(v) == Approx(f[v]));
    CHECK(result.kept == Approx(1));
    CHECK(result.last_eigenvalue == functions.back().eigenvalue);
  }
}

TEST_CASE("all eigenfunctions together keep every field") {
  for (const auto& [name, mesh] : mesh_zoo()) {
    INFO(name);
    const ScalarField field(mesh, random_values(mesh.vertex_count(), 11));
    const auto result = morse::spectral(field, morse::nonconstant_eigenfunction_count(mesh));
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(result.field.value(v) == Approx(field.value(v)).margin(1e-9));
    const auto points = morse::classify(morse::spectral(field, 1).field);
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          mesh.euler_characteristic());
  }
}

TEST_CASE("projecting twice is projecting once and scaling goes through") {
  const TriangleMesh mesh = torus(20, 15).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 2));
  const ScalarField once = morse::spectral(field, 7).field;
  const ScalarField twice = morse::spectral(once, 7).field;
  std::vector<double> huge = values_of(field);
  for (double& value : huge) value = value * 1e305 - 4e304;
  const ScalarField large = morse::spectral({mesh, huge}, 7).field;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(twice.value(v) == Approx(once.value(v)).margin(1e-12));
    CHECK(large.value(v) / 1e305 + 0.4 == Approx(once.value(v)).margin(1e-12));
  }
}

TEST_CASE("a constant field keeps its order") {
  const TriangleMesh mesh = sphere(1).mesh();
  for (const double value : {0.0, 3.0}) {
    const ScalarField field(mesh, std::vector<double>(mesh.vertex_count(), value));
    const auto result = morse::spectral(field, 3);
    CHECK(result.field.min() == Approx(value));
    CHECK(result.field.max() == Approx(value));
    CHECK(result.kept == Approx(1).margin(value == 0 ? 0 : 1));
  }
}

TEST_CASE("the spectral method resolves its parameters") {
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 4));
  const core::MethodResult result = apply_spectral(field, {});
  CHECK(result.parameters == core::Parameters{{"modes", std::int64_t{20}}});
  CHECK(values_of(result.field) == values_of(morse::spectral(field, 20).field));
  REQUIRE(result.details.size() == 2);
  CHECK(result.details[0].first == "last_eigenvalue");
  CHECK(result.details[1].first == "variance_kept");
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    CHECK(values_of(apply_spectral(field, {}).field) == values_of(result.field));
  }
  CHECK_THROWS_AS(apply_spectral(field, {{"modes", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(apply_spectral(field, {{"modes", "1001"}}), core::InvalidArgument);
  CHECK_THROWS_AS(apply_spectral({octahedron().mesh(), {1, 2, 3, 4, 5, 6}}, {{"modes", "6"}}),
                  core::BadInput);
}

TEST_CASE("counts of few modes on the samples") {
  for (const auto& [file, modes, total] :
       {std::tuple{"lion-head.off", "10", 9U}, std::tuple{"bunny00.off", "10", 10U}}) {
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    const auto points = morse::classify(apply_spectral(field, {{"modes", modes}}).field);
    CHECK(points.total() == total);
  }
}
