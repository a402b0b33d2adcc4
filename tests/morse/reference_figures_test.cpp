// Counts of critical points that an independent implementation in double precision found, mean curvature,
// σ = 8ε. Only the order of floating-point sums should separate these from ours: more than 0.5 % or two
// points apart means another algorithm.

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/smoothing/salient.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

namespace {

ScalarField curvature_of(const std::string& file) {
  return morse::mean_curvature(core::read_mesh(sample(file)).mesh);
}

/// Runs as many iterations as the last of `expected` (by iteration) has, and looks at each that it names.
void check_totals(const std::string& file, const char* range, double support,
                  const std::map<int, double>& expected) {
  const ScalarField field = curvature_of(file);
  morse::SalientOptions options;
  options.range = morse::parse_value_range(range, "range");
  options.support = support;
  options.iterations = expected.rbegin()->first;
  std::size_t looked_at = 0;
  options.on_iteration = [&](const morse::SalientIteration& iteration) {
    const auto found = expected.find(iteration.number);
    if (found == expected.end()) return true;
    ++looked_at;
    const morse::CriticalPoints points = morse::classify(
        {field.mesh(), std::vector<double>(iteration.values.begin(), iteration.values.end())});
    INFO(file << ", " << range << ", support " << support << ", iteration " << iteration.number);
    CHECK(static_cast<double>(points.total()) ==
          Approx(found->second).margin(std::max(2.0, 0.005 * found->second)).epsilon(0));
    CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
          field.mesh().euler_characteristic());
    return true;
  };
  morse::salient(field, options);
  CHECK(looked_at == expected.size());
}

}  // namespace

TEST_CASE("reference figures: conventional") {
  const morse::CriticalPoints lion = morse::classify(curvature_of("lion-head.off"));
  CHECK(lion.total() == 1895);
  CHECK(lion.minima == 462);
  CHECK(lion.saddles == 934);
  CHECK(lion.saddle_multiplicity == 960);
  CHECK(lion.maxima == 499);
  const morse::CriticalPoints bunny = morse::classify(curvature_of("bunny00.off"));
  CHECK(bunny.total() == 8103);
  CHECK(bunny.minima == 2068);
  CHECK(bunny.saddles == 4002);
  CHECK(bunny.saddle_multiplicity == 4099);
  CHECK(bunny.maxima == 2033);
}

TEST_CASE("reference figures: lion head by standard deviations") {
  check_totals("lion-head.off", "1std", 2, {{1, 1033}, {5, 137}, {10, 97}, {20, 65}});
  check_totals("lion-head.off", "1std", 1, {{1, 1113}, {5, 314}, {10, 203}, {20, 163}});
}

TEST_CASE("reference figures: lion head by the local range") {
  check_totals("lion-head.off", "local", 2, {{1, 533}, {5, 75}, {10, 73}, {20, 59}});
  check_totals("lion-head.off", "local", 1, {{1, 872}, {5, 221}, {10, 136}, {20, 111}});
}

TEST_CASE("reference figures: lion head by the literal range") {
  check_totals("lion-head.off", "literal", 2, {{10, 1891}});
  check_totals("lion-head.off", "literal", 1, {{10, 1881}});
}

TEST_CASE("reference figures: bunny by standard deviations with support 2") {
  check_totals("bunny00.off", "1std", 2, {{1, 4892}, {5, 198}, {10, 62}, {20, 36}});
}

TEST_CASE("reference figures: bunny by standard deviations with support 1") {
  check_totals("bunny00.off", "1std", 1, {{1, 4246}, {5, 363}, {10, 195}, {20, 114}});
}

TEST_CASE("reference figures: bunny by the local range with support 2") {
  check_totals("bunny00.off", "local", 2, {{1, 2186}, {5, 80}, {10, 66}, {20, 26}});
}

TEST_CASE("reference figures: bunny by the local range with support 1") {
  check_totals("bunny00.off", "local", 1, {{1, 3016}, {5, 300}, {10, 192}, {20, 124}});
}

TEST_CASE("reference figures: bunny by the literal range") {
  check_totals("bunny00.off", "literal", 2, {{10, 8087}});
  check_totals("bunny00.off", "literal", 1, {{10, 8045}});
}
