#include "morsel/core/scalar_field.h"

#include <catch2/catch.hpp>
#include <limits>

#include "morsel/core/error.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

TEST_CASE("the order is by value, then by vertex") {
  const ScalarField field(square_pair().mesh(), {2.0, -1.0, 2.0, -0.0});
  CHECK(std::vector<Index>(field.order().begin(), field.order().end()) == std::vector<Index>{1, 3, 0, 2});
  CHECK(field.rank(2) == 3);
  CHECK(field.min() == -1.0);
  CHECK(field.extent() == 3.0);
}

TEST_CASE("zero and minus zero are equal values") {
  const ScalarField field(square_pair().mesh(), {0.0, -0.0, 0.0, -0.0});
  CHECK(std::vector<Index>(field.order().begin(), field.order().end()) == std::vector<Index>{0, 1, 2, 3});
}

TEST_CASE("a field refuses non-finite values and wrong sizes") {
  const TriangleMesh mesh = square_pair().mesh();
  CHECK_THROWS_AS(ScalarField(mesh, {1.0, 2.0}), core::InvalidArgument);
  CHECK_THROWS_WITH(ScalarField(mesh, {1.0, std::numeric_limits<double>::quiet_NaN(), 2.0, INFINITY}),
                    Catch::Contains("2 non-finite values") && Catch::Contains("vertex 1"));
}

TEST_CASE("an explicit order must be a permutation that agrees with the values") {
  const TriangleMesh mesh = square_pair().mesh();
  CHECK(ScalarField(mesh, {1, 1, 1, 0}, {3, 2, 1, 0}).order()[3] == 0);
  CHECK_THROWS_AS(ScalarField(mesh, {1, 1, 1, 0}, {3, 2, 2, 0}), core::InvalidArgument);
  CHECK_THROWS_AS(ScalarField(mesh, {1, 1, 1, 0}, {0, 1, 2, 3}), core::InvalidArgument);
  CHECK_THROWS_AS(ScalarField(mesh, {1, 1, 1, 0}, {0, 1, 2, 4}), core::InvalidArgument);
}

TEST_CASE("negating turns the order round, ties included") {
  const ScalarField field(square_pair().mesh(), {1, 1, 0, 1});
  const ScalarField negated = field.negated();
  for (Index v = 0; v < 4; ++v) {
    CHECK(negated.rank(v) == 3 - field.rank(v));
    CHECK(negated.value(v) == -field.value(v));
  }
}
