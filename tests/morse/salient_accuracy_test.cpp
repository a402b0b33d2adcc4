// The near-linear algorithm of salient smoothing: what it promises, when it runs, and that it gives way.

#include <catch2/catch.hpp>
#include <cmath>

#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::Length;
using core::ScalarField;
using morse::SalientAlgorithm;
using morse::SalientOptions;

namespace {

SalientOptions options(double accuracy, double sigma, const char* range, double support = 2,
                       int iterations = 3) {
  SalientOptions result;
  result.iterations = iterations;
  result.sigma = Length::absolute(sigma);
  result.range = morse::parse_value_range(range, "range");
  result.support = support;
  result.accuracy = accuracy;
  result.always_near_linear = true;
  return result;
}

/// The largest difference between the algorithms, over the input's extent.
double error_of(const ScalarField& field, SalientOptions chosen, const morse::SalientResult& found) {
  chosen.accuracy = 0;
  const auto exact = morse::salient(field, chosen);
  CHECK(exact.algorithm == SalientAlgorithm::exact);
  CHECK(exact.promised_error == 0);
  CHECK(found.pairs == exact.pairs);
  double worst = 0;
  for (Index v = 0; v < field.mesh().vertex_count(); ++v)
    worst = std::max(worst, std::abs(found.field.value(v) - exact.field.value(v)));
  return worst / (field.max() - field.min());
}

Soup noisy(Soup soup, double amount, unsigned seed) {
  const std::vector<double> noise = random_values(3 * soup.positions.size(), seed);
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      soup.positions[v][axis] += amount * (2 * noise[3 * v + static_cast<std::size_t>(axis)] - 1);
  return soup;
}

/// Smooth, uniform noise, noise with heavy tails, and a few far values among many near ones.
std::vector<NamedField> fields_of(const TriangleMesh& mesh) {
  const std::size_t n = mesh.vertex_count();
  std::vector<double> height(n), tails(n), spikes(n);
  const std::vector<double> uniform = random_values(n, 31);
  const std::vector<double> other = random_values(n, 32);
  for (std::size_t v = 0; v < n; ++v) {
    height[v] = mesh.positions()[v].z() + 0.3 * mesh.positions()[v].x();
    tails[v] = height[v] + 0.3 * std::tan(3 * (uniform[v] - 0.5));
    spikes[v] = 0.1 * height[v] + 0.05 * uniform[v] + (other[v] < 0.01 ? 5 * uniform[v] : 0);
  }
  return {{"height", {mesh, height}},
          {"uniform", {mesh, uniform}},
          {"tails", {mesh, tails}},
          {"spikes", {mesh, spikes}}};
}

/// Checks the promise; true if the near-linear algorithm kept it itself.
bool check_promise(const NamedField& entry, const SalientOptions& chosen) {
  const auto found = morse::salient(entry.field, chosen);
  const double error = error_of(entry.field, chosen, found);
  INFO(entry.name << ", " << to_string(chosen.range) << ", support " << chosen.support << ", accuracy "
                  << chosen.accuracy << ": error " << error << ", estimate " << found.estimated_error << " "
                  << found.reason);
  CHECK(error <= chosen.accuracy);
  CHECK(found.promised_error == chosen.accuracy);
  const bool near_linear = found.algorithm == SalientAlgorithm::near_linear;
  CHECK(found.reason.empty() == near_linear);
  if (near_linear) CHECK(found.estimated_error <= chosen.accuracy);
  if (near_linear) CHECK(error > 0);
  if (near_linear) CHECK(error <= 1e-4);
  // An estimate that is no bound, but no less than half of the truth.
  if (near_linear) CHECK(error <= 2 * found.estimated_error);
  return near_linear;
}

}  // namespace

TEST_CASE("near linear smoothing keeps its promise on a closed surface") {
  const TriangleMesh mesh = noisy(sphere(5), 0.001, 1).mesh();
  int near_linear = 0;
  for (const NamedField& entry : fields_of(mesh))
    for (const char* range : {"1std", "0.5std", "literal"})
      near_linear += check_promise(entry, options(2e-3, 0.8, range));
  CHECK(near_linear >= 9);
}

TEST_CASE("near linear smoothing keeps its promise with other supports") {
  const TriangleMesh mesh = noisy(sphere(5), 0.001, 2).mesh();
  int near_linear = 0;
  for (const NamedField& entry : fields_of(mesh))
    for (const double support : {1.0, 3.0})
      near_linear += check_promise(entry, options(2e-3, support > 2 ? 0.6 : 1, "1std", support));
  CHECK(near_linear >= 6);
}

TEST_CASE("near linear smoothing keeps its promise with borders and several components") {
  Soup far = noisy(torus(100, 60), 0.001, 3);
  for (Point& p : far.positions) p = 0.4 * p;
  int near_linear = 0;
  for (const TriangleMesh& mesh :
       {noisy(grid(110, 90), 0.02, 4).mesh(), together(noisy(sphere(4), 0.001, 5), far).mesh(),
        noisy(punctured_sphere(5, 9), 0.001, 6).mesh()}) {
    const double sigma = 0.2 * mesh.bounding_box().diagonal();
    for (const NamedField& entry : fields_of(mesh))
      near_linear += check_promise(entry, options(2e-3, sigma, "1std"));
  }
  CHECK(near_linear >= 8);
}

TEST_CASE("near linear smoothing gives the same bits for every number of threads and any memory") {
  const TriangleMesh mesh = noisy(sphere(5), 0.001, 7).mesh();
  const ScalarField field = fields_of(mesh)[2].field;
  std::vector<double> expected;
  for (const int threads : {1, 2, 5})
    for (const std::size_t memory : {std::size_t{0}, std::size_t{1'000'000}, std::size_t{1} << 30}) {
      const core::ThreadLimit limit(threads);
      SalientOptions chosen = options(2e-3, 0.7, "1std", 2, 2);
      chosen.memory = memory;
      const auto result = morse::salient(field, chosen);
      CHECK(result.algorithm == SalientAlgorithm::near_linear);
      const std::vector<double> values(result.field.values().begin(), result.field.values().end());
      if (expected.empty()) expected = values;
      CHECK(values == expected);
    }
}

TEST_CASE("every instruction set keeps the promise and fused ones give the same bits") {
  const TriangleMesh mesh = noisy(sphere(5), 0.001, 8).mesh();
  const ScalarField field = fields_of(mesh)[2].field;
  std::vector<double> expected;
  for (const morse::InstructionSet set : morse::instruction_sets()) {
    INFO(to_string(set));
    SalientOptions chosen = options(2e-3, 0.7, "1std", 2, 3);
    chosen.instructions = set;
    const auto result = morse::salient(field, chosen);
    CHECK(result.algorithm == SalientAlgorithm::near_linear);
    CHECK(error_of(field, chosen, result) <= 1e-4);
    if (set == morse::InstructionSet::baseline) continue;
    const std::vector<double> values(result.field.values().begin(), result.field.values().end());
    if (expected.empty()) expected = values;
    CHECK(values == expected);
  }
}

TEST_CASE("the exact algorithm runs where the accuracy cannot be kept, and the reason is reported") {
  const TriangleMesh mesh = noisy(sphere(4), 0.001, 9).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 10));
  const auto why = [&](const SalientOptions& chosen) {
    const auto found = morse::salient(field, chosen);
    CHECK(found.algorithm == SalientAlgorithm::exact);
    CHECK(found.promised_error == (chosen.accuracy < 1e-5 ? 0 : chosen.accuracy));
    SalientOptions exact = chosen;
    exact.accuracy = 0;
    if (chosen.accuracy >= 1e-5) exact.precision = morse::Precision::float32;
    const auto expected = morse::salient(field, exact);
    CHECK(expected.reason.empty());
    CHECK(std::equal(found.field.values().begin(), found.field.values().end(),
                     expected.field.values().begin()));
    return found.reason;
  };
  CHECK_THAT(why(options(1e-4, 0.8, "local")), Catch::Contains("local"));
  CHECK_THAT(why(options(1e-6, 0.8, "1std")), Catch::Contains("1e-05"));
  CHECK_THAT(why(options(2e-3, 0.05, "1std")), Catch::Contains("too few vertices"));
  CHECK_THAT(why(options(2e-3, 0.8, "1e-9")), Catch::Contains("spread too far"));
  SalientOptions small = options(0.02, 1, "1std");
  small.always_near_linear = false;
  CHECK_THAT(why(small), Catch::Contains("faster"));
  // A constant field has no values to share.
  const ScalarField constant(mesh, std::vector<double>(mesh.vertex_count(), 0.3));
  CHECK(morse::salient(constant, options(1e-3, 0.8, "1std")).algorithm == SalientAlgorithm::exact);
}
