#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "morsel/core/error.h"
#include "morsel/morse/critical_points.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/threshold.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using persistence::parse_threshold;
using persistence::Threshold;

namespace {

core::MethodResult apply_tps(const Given& given, const ScalarField& field) {
  return made(persistence::make_tps, "tps", given)->apply(field, {});
}

template <class T>
T value_of(const core::Parameters& parameters, const std::string& key) {
  for (const auto& [name, value] : parameters)
    if (name == key) return std::get<T>(value);
  throw std::logic_error("no parameter " + key);
}

bool has(const core::Parameters& parameters, const std::string& key) {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const auto& entry) { return entry.first == key; });
}

}  // namespace

TEST_CASE("thresholds are read and written") {
  CHECK(parse_threshold("0.1%", "t").value == 0.1);
  CHECK(parse_threshold("0.1%", "t").in_percent);
  CHECK(parse_threshold("3.5", "t").value == 3.5);
  CHECK_FALSE(parse_threshold("3.5", "t").in_percent);
  CHECK(parse_threshold("0", "t").value == 0);
  for (const char* text : {"0.1%", "3.5", "1e-300", "250%"})
    CHECK(persistence::to_string(parse_threshold(text, "t")) == text);
  for (const char* text :
       {"", "%", "-1", "-0.5%", "inf", "nan", "nan%", "1e999", "1 %", "1%%", "one", "0x10", "1,5"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_threshold(text, "tps:threshold"), core::InvalidArgument);
  }
  CHECK_THROWS_WITH(parse_threshold("-1%", "tps:threshold"),
                    Catch::Contains("tps:threshold") && Catch::Contains("\"-1%\""));
}

TEST_CASE("a threshold in percent is a share of the extent") {
  const ScalarField field(square_pair().mesh(), {-2, 6, 0, 1});
  CHECK(Threshold::percent(50).on(field) == 4);
  CHECK(Threshold::absolute(50).on(field) == 50);
  CHECK_THROWS_AS(Threshold::percent(-1).on(field), core::InvalidArgument);
  CHECK_THROWS_AS(Threshold::absolute(std::numeric_limits<double>::infinity()).on(field),
                  core::InvalidArgument);
  const ScalarField huge(square_pair().mesh(), {-1e308, 1.7e308, 0, 1});
  CHECK(Threshold::percent(1).on(huge) == Approx(2.7e306));
}

TEST_CASE("tps cancels one in a thousand of the extent by default and reports what that is") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 9));
  const core::MethodResult result = apply_tps({}, field);
  CHECK(value_of<double>(result.parameters, "threshold") == field.extent() * (0.1 / 100));
  CHECK(value_of<double>(result.parameters, "threshold_percent") == 0.1);
  CHECK_FALSE(has(result.parameters, "count"));

  const core::MethodResult absolute = apply_tps({{"threshold", "0.25"}}, field);
  CHECK(value_of<double>(absolute.parameters, "threshold") == 0.25);
  CHECK_FALSE(has(absolute.parameters, "threshold_percent"));
  CHECK(value_of<std::int64_t>(absolute.details, "cancelled_pairs") > 0);
  CHECK(value_of<double>(absolute.details, "largest_cancelled") <= 0.25);
  CHECK(value_of<std::int64_t>(absolute.details, "reached_count") ==
        static_cast<std::int64_t>(morse::classify(absolute.field).total()));
}

TEST_CASE("tps cancels to a count") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 9));
  const core::MethodResult result = apply_tps({{"count", "10"}}, field);
  CHECK(value_of<std::int64_t>(result.parameters, "count") == 10);
  CHECK_FALSE(has(result.parameters, "threshold"));
  CHECK(morse::classify(result.field).total() == 10);
  CHECK_FALSE(has(result.details, "note"));

  const core::MethodResult least = apply_tps({{"count", "1"}}, field);
  CHECK(value_of<std::int64_t>(least.details, "reached_count") == 2);
  CHECK_THAT(value_of<std::string>(least.details, "note"), Catch::Contains("essential"));
}

TEST_CASE("tps refuses what it cannot do") {
  const ScalarField field(octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3});
  CHECK_THROWS_WITH(apply_tps({{"threshold", "1%"}, {"count", "3"}}, field), Catch::Contains("not both"));
  CHECK_THROWS_AS(apply_tps({{"count", "0"}}, field), core::InvalidArgument);
  CHECK_THROWS_AS(apply_tps({{"count", "-3"}}, field), core::InvalidArgument);
  CHECK_THROWS_AS(apply_tps({{"count", "3.5"}}, field), core::InvalidArgument);
  CHECK_THROWS_AS(apply_tps({{"threshold", "-3"}}, field), core::InvalidArgument);
  CHECK_THROWS_AS(apply_tps({{"persistence", "3"}}, field), core::InvalidArgument);
  core::ParameterReader help = core::ParameterReader::for_help("tps");
  persistence::make_tps(help);
  CHECK(help.declared().size() == 2);
  CHECK(help.declared()[0].default_value == "0.1%");
}
