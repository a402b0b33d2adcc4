#include "morsel/core/field/scalar_field.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "morsel/core/error.h"
#include "morsel/core/field/vertex_order.h"
#include "morsel/core/parallel/parallel.h"
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

TEST_CASE("negating reverses the order, ties included") {
  const ScalarField field(square_pair().mesh(), {1, 1, 0, 1});
  const ScalarField negated = field.negated();
  for (Index v = 0; v < 4; ++v) {
    CHECK(negated.rank(v) == 3 - field.rank(v));
    CHECK(negated.value(v) == -field.value(v));
  }
}

namespace {

/// By comparisons alone.
std::vector<Index> sorted_plainly(const std::vector<double>& values, const std::vector<Index>& before) {
  std::vector<Index> order = before;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

TEST_CASE("the radix sort orders as comparisons do whatever the values") {
  std::mt19937 generator(7);
  const auto random = [&] { return static_cast<double>(generator()) / std::mt19937::max(); };
  const std::vector<std::pair<std::string, std::function<double()>>> kinds = {
      {"uniform", random},
      {"signed", [&] { return random() - 0.5; }},
      {"few values", [&] { return std::floor(4 * random()); }},
      {"constant", [] { return 3.25; }},
      {"zeros of both signs", [&] { return random() < 0.5 ? 0.0 : -0.0; }},
      {"crowded beside an outlier", [&] { return random() < 1e-4 ? 1e300 : 1 + 1e-9 * random(); }},
      {"crowded around zero", [&] { return random() < 0.5 ? random() : 1e-300 * (random() - 0.5); }},
      {"every magnitude",
       [&] { return std::ldexp(random() - 0.5, static_cast<int>(2000 * random()) - 1000); }},
      {"subnormal", [&] { return std::numeric_limits<double>::denorm_min() * std::floor(1000 * random()); }},
      {"far from zero", [&] { return 1e15 + std::floor(100 * random()); }}};
  for (const auto& [name, value] : kinds)
    for (const std::size_t n :
         {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{100}, std::size_t{200000}}) {
      CAPTURE(name, n);
      std::vector<double> values(n);
      for (double& x : values) x = value();
      std::vector<Index> before(n);
      std::iota(before.begin(), before.end(), Index{0});
      const auto plain = sorted_plainly(values, before);
      std::shuffle(before.begin(), before.end(), generator);
      const auto plain_after = sorted_plainly(values, before);
      for (const int threads : {1, 4}) {
        const core::ThreadLimit limit(threads);
        const auto order = core::vertex_order(values);
        REQUIRE(std::equal(order.begin(), order.end(), plain.begin(), plain.end()));
        const auto after = core::vertex_order(values, before);
        REQUIRE(std::equal(after.begin(), after.end(), plain_after.begin(), plain_after.end()));
        const auto rank = core::inverse(order);
        for (std::size_t i = 0; i < n; ++i) REQUIRE(rank[order[i]] == i);
      }
    }
}
