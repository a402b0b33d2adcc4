#include "morsel/morse/functions/height.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/morse/critical_points.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

core::FunctionResult evaluate_height(const TriangleMesh& mesh, Given given) {
  return made(morse::make_height, "height", std::move(given))->evaluate(mesh, {});
}

}  // namespace

TEST_CASE("height along an axis is the coordinate") {
  const TriangleMesh mesh = torus(9, 7).mesh();
  const ScalarField z = morse::height(mesh);
  const ScalarField down = morse::height(mesh, {{0, 0, -3}});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CHECK(z.value(v) == mesh.position(v).z());
    CHECK(down.value(v) == -mesh.position(v).z());
  }
  const std::vector<std::string> axes = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const core::FunctionResult result = evaluate_height(mesh, {{"axis", axes[axis]}});
    CHECK(result.parameters == core::Parameters{{"axis", axes[axis]}});
    for (Index v = 0; v < mesh.vertex_count(); ++v) CHECK(result.field.value(v) == mesh.position(v)[axis]);
  }
  CHECK(evaluate_height(mesh, {}).parameters == core::Parameters{{"axis", "z"}});
}

TEST_CASE("the length of a direction does not matter") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField reference = morse::height(mesh, {{3, 0, 4}});
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    CHECK(reference.value(v) ==
          Approx(0.6 * mesh.position(v).x() + 0.8 * mesh.position(v).z()).margin(1e-15));
  for (const double length : {1e-310, 1e-3, 1e300}) {
    const ScalarField other = morse::height(mesh, {Point(3, 0, 4) * length});
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      CHECK(other.value(v) == Approx(reference.value(v)).margin(1e-13));
  }
  CHECK(evaluate_height(mesh, {{"direction", "3/0/4"}}).field.value(5) == reference.value(5));
  CHECK(evaluate_height(mesh, {{"direction", "3/0/4"}}).parameters ==
        core::Parameters{{"direction", "3/0/4"}});
}

TEST_CASE("height on a torus that stands has one minimum one maximum and two saddles") {
  const auto points = morse::classify(morse::height(torus(40, 30).mesh(), {{1, 0.02, 0.03}}));
  CHECK(points.minima == 1);
  CHECK(points.maxima == 1);
  CHECK(points.saddle_multiplicity == 2);
}

TEST_CASE("height refuses zero and non-finite directions") {
  const TriangleMesh mesh = octahedron().mesh();
  CHECK_THROWS_AS(morse::height(mesh, {{0, 0, 0}}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::height(mesh, {{0, INFINITY, 0}}), core::InvalidArgument);
  CHECK_THROWS_AS(morse::height(mesh, {{NAN, 1, 0}}), core::InvalidArgument);
}

TEST_CASE("height keys are checked") {
  const TriangleMesh mesh = octahedron().mesh();
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"axis", "w"}}), Catch::Contains("must be x, y or z"));
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"axis", "z"}, {"direction", "1/0/0"}}),
                    Catch::Contains("not both"));
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"direction", "1/2"}}), Catch::Contains("three numbers"));
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"direction", "1/2/3/4"}}), Catch::Contains("three numbers"));
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"direction", "1//3"}}), Catch::Contains("height:direction"));
  CHECK_THROWS_AS(evaluate_height(mesh, {{"direction", "0/0/-0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_height(mesh, {{"direction", "nan/0/1"}}), core::InvalidArgument);
  CHECK_THROWS_AS(evaluate_height(mesh, {{"direction", ""}}), core::InvalidArgument);
  CHECK_THROWS_WITH(evaluate_height(mesh, {{"speed", "1"}}), Catch::Contains("axis, direction"));
  core::ParameterReader help = core::ParameterReader::for_help("height");
  CHECK_NOTHROW(morse::make_height(help));
  CHECK(help.declared().size() == 2);
}
