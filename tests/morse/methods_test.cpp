#include <catch2/catch.hpp>

#include "morsel/core/error.h"
#include "morsel/morse/smoothing/conventional.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

core::MethodResult apply_salient(const ScalarField& field, Given given) {
  return made(morse::make_salient, "salient", std::move(given))->apply(field, {});
}

}  // namespace

TEST_CASE("the conventional method returns the field with its order") {
  core::ParameterReader reader({"conventional", {}});
  const auto method = morse::make_conventional(reader);
  reader.finish();
  const ScalarField field(square_pair().mesh(), {1, 1, 0, 1}, {3, 2, 0, 1});
  const core::MethodResult result = method->apply(field, {});
  CHECK(values_of(result.field) == values_of(field));
  CHECK(std::equal(result.field.ranks().begin(), result.field.ranks().end(), field.ranks().begin()));
  CHECK(result.field.mesh().is_same(field.mesh()));
  CHECK(result.parameters.empty());
  core::ParameterReader wrong({"conventional", {{"iterations", "3"}}});
  morse::make_conventional(wrong);
  CHECK_THROWS_AS(wrong.finish(), core::InvalidArgument);
}

TEST_CASE("the salient method resolves its parameters on the mesh") {
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 3));
  const core::MethodResult result = apply_salient(field, {});
  const morse::SalientResult direct = morse::salient(field);
  CHECK(values_of(result.field) == values_of(direct.field));
  CHECK(result.parameters == core::Parameters{{"iterations", std::int64_t{10}},
                                              {"sigma", 8 * mesh.epsilon()},
                                              {"range", "1std"},
                                              {"support", 2.0},
                                              {"classify", "smoothed"},
                                              {"precision", "double"},
                                              {"accuracy", 0.0},
                                              {"weights", "none"},
                                              {"ball", "euclidean"},
                                              {"sigma_s", *direct.sigma_s}});
  CHECK(result.details == core::Parameters{{"pairs_per_iteration", static_cast<std::int64_t>(direct.pairs)},
                                           {"algorithm", "exact"},
                                           {"promised_error", 0.0},
                                           {"iterations_run", std::int64_t{10}},
                                           {"stopped_by", "iterations"}});
  const core::MethodResult small = apply_salient(field, {{"accuracy", "1e-4"}, {"iterations", "1"}});
  CHECK(small.parameters[6] == core::Parameters::value_type{"accuracy", 1e-4});
  REQUIRE(small.details.size() == 6);
  CHECK(small.details[1] == core::Parameters::value_type{"algorithm", "exact"});
  CHECK(small.details[2] == core::Parameters::value_type{"promised_error", 1e-4});
  CHECK(small.details[3].first == "exact_because");

  const core::MethodResult local = apply_salient(field, {{"iterations", "2"},
                                                         {"sigma", "0.25"},
                                                         {"range", "local"},
                                                         {"support", "1.5"},
                                                         {"classify", "saliency"}});
  CHECK(local.parameters == core::Parameters{{"iterations", std::int64_t{2}},
                                             {"sigma", 0.25},
                                             {"range", "local"},
                                             {"support", 1.5},
                                             {"classify", "saliency"},
                                             {"precision", "double"},
                                             {"accuracy", 0.0},
                                             {"weights", "none"},
                                             {"ball", "euclidean"}});
  morse::SalientOptions options{
      2, core::Length::absolute(0.25), {morse::ValueRange::Kind::local, 1}, 1.5, true};
  CHECK(values_of(local.field) == values_of(morse::salient(field, options).field));
  const core::MethodResult single = apply_salient(field, {{"sigma", "0.25"}, {"precision", "single"}});
  CHECK(single.parameters[5] == core::Parameters::value_type{"precision", "single"});
  morse::SalientOptions in_single;
  in_single.sigma = core::Length::absolute(0.25);
  in_single.precision = morse::Precision::float32;
  CHECK(values_of(single.field) == values_of(morse::salient(field, in_single).field));
  const core::MethodResult literal =
      apply_salient(field, {{"sigma", "0.1"}, {"range", "literal"}, {"iterations", "1"}});
  CHECK(literal.parameters.back() == core::Parameters::value_type{"sigma_s", 0.1});
}

TEST_CASE("salient keys are checked when the method is made") {
  const ScalarField field(octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3});
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"iterations", "-1"},  {"iterations", "2.5"}, {"iterations", "99999999999"},
      {"sigma", "0"},        {"sigma", "-8eps"},    {"sigma", "infeps"},
      {"precision", "half"}, {"sigma", "8 eps"},    {"range", "2sd"},
      {"range", "0"},        {"support", "0"},      {"support", "nan"},
      {"classify", "both"},  {"sigmas", "3"},       {"accuracy", "-1e-4"},
      {"accuracy", "2"},     {"accuracy", "exact"}, {"weights", "mass"},
      {"ball", "round"},     {"preset", "best"},    {"scale", "-1edges"},
      {"scale", "wide"}};
  for (const auto& [key, value] : bad) {
    INFO(key << "=" << value);
    CHECK_THROWS_AS(apply_salient(field, {{key, value}}), core::InvalidArgument);
    CHECK_THROWS_WITH(apply_salient(field, {{key, value}}),
                      Catch::Contains("salient") && Catch::Contains(key));
  }
  CHECK_THROWS_AS(apply_salient(field, {{"iterations", "0"}, {"classify", "saliency"}}),
                  core::InvalidArgument);
  core::ParameterReader help = core::ParameterReader::for_help("salient");
  morse::make_salient(help);
  REQUIRE(help.declared().size() == 14);
  const std::vector<std::pair<std::string, std::string>> defaults = {
      {"preset", "paper"},      {"iterations", "10"},     {"until-count", "none"},
      {"until-stable", "none"}, {"until-change", "none"}, {"sigma", "8eps"},
      {"range", "1std"},        {"support", "2"},         {"classify", "smoothed"}};
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    CHECK(help.declared()[i].key == defaults[i].first);
    CHECK(help.declared()[i].default_value == defaults[i].second);
  }
}
