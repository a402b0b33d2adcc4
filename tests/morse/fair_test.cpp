#include "morsel/morse/smoothing/fair.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/critical_points.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/diagram.h"
#include "morsel/persistence/pairing.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::CriticalType;
using morse::FairOptions;
using morse::FairValues;

namespace {

std::vector<Index> persistent(const ScalarField& field, std::size_t count) {
  return persistence::persistent_extrema(persistence::pair_extrema(field), count);
}

ScalarField cancel(const ScalarField& field, double threshold) {
  return persistence::cancel(field, {persistence::Threshold::absolute(threshold), {}}).field;
}

core::MethodResult apply_fair(const ScalarField& field, Given given, const core::MethodContext& with = {}) {
  return made(morse::make_fair, "fair", std::move(given))->apply(field, with);
}

Index least_extrema(const TriangleMesh& mesh) {
  Index least = 0;
  for (Index c = 0; c < mesh.component_count(); ++c) least += mesh.boundary_loop_count(c) == 0 ? 2 : 1;
  return least;
}

/// The extrema of the field are the chosen ones, and the Euler identity holds.
void check_extrema(const ScalarField& field, const ScalarField& input, const std::vector<Index>& chosen) {
  const morse::CriticalPoints points = morse::classify(field);
  std::set<std::pair<Index, CriticalType>> expected, found;
  for (const Index v : chosen) expected.emplace(v, morse::classify_vertex(input, v).type);
  for (const morse::CriticalPoint& point : points.points)
    if (point.type != CriticalType::saddle) found.emplace(point.vertex, point.type);
  CHECK(found == expected);
  CHECK(static_cast<long>(points.minima + points.maxima) - static_cast<long>(points.saddle_multiplicity) ==
        field.mesh().euler_characteristic());
}

void check_fair(const ScalarField& input, std::size_t count) {
  const std::vector<Index> chosen = persistent(input, count);
  const morse::FairResult result = morse::fair(input, chosen, {}, cancel);
  check_extrema(result.field, input, chosen);
  CHECK(result.left == chosen.size());
  CHECK(result.minima + result.maxima == chosen.size());
  for (const Index v : chosen)
    CHECK(result.field.value(v) ==
          (morse::classify_vertex(input, v).type == CriticalType::minimum ? input.min() : input.max()));
  CHECK(result.field.min() == input.min());
  CHECK(result.field.max() <= input.max());
}

/// A finger: a tube of radius 1 and the given length, closed by a vertex at either end (0 and the last).
Soup finger(int around, int rings, double length) {
  Soup soup;
  soup.positions.emplace_back(0, 0, -0.5);
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < around; ++a) {
      const double angle = 2 * std::numbers::pi * a / around;
      soup.positions.emplace_back(std::cos(angle), std::sin(angle), length * r / (rings - 1));
    }
  soup.positions.emplace_back(0, 0, length + 0.5);
  const auto at = [&](int r, int a) { return static_cast<Index>(1 + r * around + a % around); };
  for (int a = 0; a < around; ++a) {
    soup.triangles.push_back({0, at(0, a + 1), at(0, a)});
    for (int r = 0; r + 1 < rings; ++r) {
      soup.triangles.push_back({at(r, a), at(r, a + 1), at(r + 1, a + 1)});
      soup.triangles.push_back({at(r, a), at(r + 1, a + 1), at(r + 1, a)});
    }
    soup.triangles.push_back(
        {at(rings - 1, a), at(rings - 1, a + 1), static_cast<Index>(soup.positions.size() - 1)});
  }
  return soup;
}

}  // namespace

TEST_CASE("a fair function is harmonic between its extrema") {
  // From one end of a tube to the other: linear.
  const TriangleMesh mesh = finger(12, 21, 20).mesh();
  std::vector<double> height(mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) height[v] = mesh.position(v).z();
  const ScalarField input(mesh, height);
  const morse::FairResult result = morse::fair(input, persistent(input, 2), {}, cancel);
  for (Index v = 13; v + 13 < mesh.vertex_count(); ++v) {
    const int ring = static_cast<int>((v - 1) / 12);
    CHECK(result.field.value(v) ==
          Approx(result.field.value(1) + (result.field.value(13) - result.field.value(1)) * ring));
  }
  const ScalarField noisy(mesh, random_values(mesh.vertex_count(), 6));
  for (const morse::EdgeWeights weights : {morse::EdgeWeights::clamped, morse::EdgeWeights::uniform}) {
    const ScalarField g = morse::fair(noisy, persistent(noisy, 9), {FairValues::ends, weights}, cancel).field;
    const std::vector<Index> chosen = persistent(noisy, 9);
    const std::vector<double> w = morse::edge_weights(mesh, weights);
    std::vector<double> flow(mesh.vertex_count(), 0.0);
    for (Index e = 0; e < mesh.edge_count(); ++e) {
      const auto [a, b] = mesh.edge_vertices(e);
      flow[a] += w[e] * (g.value(a) - g.value(b));
      flow[b] += w[e] * (g.value(b) - g.value(a));
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (std::find(chosen.begin(), chosen.end(), v) == chosen.end()) CHECK(std::abs(flow[v]) < 1e-10);
  }
}

TEST_CASE("a fair function has exactly the chosen extrema on every mesh") {
  for (const auto& [mesh_name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 5)) {
      INFO(mesh_name << ", " << field_name);
      const std::size_t least = least_extrema(mesh);
      const std::size_t all = persistent(field, mesh.vertex_count()).size();
      for (const std::size_t count : {least, least + 1, least + 3, (least + all) / 2, all})
        check_fair(field, std::min(count, all));
    }
}

TEST_CASE("a fair function has exactly the chosen extrema on random surfaces") {
  for (unsigned seed = 0; seed < 400; ++seed) {
    INFO(seed);
    const TriangleMesh mesh = random_surface(seed);
    const ScalarField field(mesh, tied_values(mesh.vertex_count(), 2 + static_cast<int>(seed % 40), seed));
    const std::size_t all = persistent(field, mesh.vertex_count()).size();
    const std::size_t least = least_extrema(mesh);
    check_fair(field, least + seed % (all - least + 1));
  }
}

TEST_CASE("flat ends of a long tube grow no extrema") {
  for (const double length : {60.0, 400.0, 2000.0}) {
    INFO(length);
    const TriangleMesh mesh = finger(16, static_cast<int>(length), length).mesh();
    std::vector<double> values = random_values(mesh.vertex_count(), 3);
    values[40] = -5;  // both near one end: the other is flat to the last bit
    values[70] = 5;
    const ScalarField input(mesh, values);
    check_fair(input, 2);
    check_fair(input, 20);
    CHECK(morse::fair(input, persistent(input, 2), {}, cancel).rounding > 0);
  }
}

TEST_CASE("real meshes have exactly the extrema that are asked for") {
  for (const char* file : {"lion-head.off", "bunny00.off", "elephant.off"}) {
    const ScalarField field = morse::mean_curvature(core::read_mesh(sample(file)).mesh);
    for (const std::size_t count : {3, 30, 300}) {
      INFO(file << " " << count);
      const core::MethodResult result = apply_fair(field, {{"extrema", std::to_string(count)}});
      check_extrema(result.field, field, persistent(field, count));
    }
  }
}

TEST_CASE("extrema that keep their own values may cease to be extrema") {
  for (const auto& [mesh_name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 5)) {
      INFO(mesh_name << ", " << field_name);
      const std::vector<Index> chosen = persistent(field, least_extrema(mesh) + 4);
      const morse::FairResult result = morse::fair(field, chosen, {FairValues::input}, cancel);
      const morse::CriticalPoints points = morse::classify(result.field);
      CHECK(points.minima + points.maxima == result.left + result.turned);
      CHECK(result.left + result.turned <= chosen.size());
      for (const morse::CriticalPoint& point : points.points)
        if (point.type != CriticalType::saddle) {
          CHECK(std::find(chosen.begin(), chosen.end(), point.vertex) != chosen.end());
          CHECK(result.field.value(point.vertex) == field.value(point.vertex));
        }
    }
}

TEST_CASE("caps of a component without chosen maxima are held at the greatest value") {
  const TriangleMesh mesh = annulus(24, 6).mesh();
  std::vector<double> values(mesh.vertex_count(), 1.0);
  values[60] = 0;
  const ScalarField input(mesh, values);
  const morse::FairResult result = morse::fair(input, std::vector<Index>{60}, {}, cancel);
  CHECK(result.held_loops == 2);
  check_extrema(result.field, input, {60});
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (v != 60) {
      CHECK(result.field.value(v) > 0);
      CHECK(result.field.value(v) < 1);
    }
  values[90] = 2;
  const ScalarField peaked(mesh, values);
  const morse::FairResult with_peak = morse::fair(peaked, std::vector<Index>{60, 90}, {}, cancel);
  CHECK(with_peak.held_loops == 0);
  check_extrema(with_peak.field, peaked, {60, 90});
}

TEST_CASE("too few extrema are refused with the least number") {
  const TriangleMesh mesh = together(together(sphere(1), torus(6, 5)), grid(4, 4)).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 8));
  CHECK_THROWS_AS(apply_fair(field, {{"extrema", "4"}}), core::BadInput);
  CHECK_THROWS_WITH(apply_fair(field, {{"extrema", "4"}}),
                    Catch::Contains("4 extrema") && Catch::Contains("at least 5"));
  CHECK_NOTHROW(apply_fair(field, {{"extrema", "5"}}));
  CHECK_THROWS_AS(apply_fair(field, {{"extrema", "0"}}), core::InvalidArgument);
  CHECK_THROWS_AS(apply_fair(field, {{"values", "mine"}}), core::InvalidArgument);
  CHECK_THROWS_AS(apply_fair(field, {{"weights", "cotangent"}}), core::InvalidArgument);
  const Index regular = [&] {
    for (Index v = 0;; ++v)
      if (morse::classify_vertex(field, v).type == CriticalType::regular) return v;
  }();
  CHECK_THROWS_AS(morse::fair(field, std::vector<Index>{regular}, {}, cancel), core::InvalidArgument);
  CHECK_THROWS_AS(
      morse::fair(field, persistent(field, 6), {FairValues::ends, morse::EdgeWeights::cotangent}, cancel),
      core::InvalidArgument);
}

TEST_CASE("the fair method resolves its parameters") {
  const TriangleMesh mesh = sphere(3).mesh();
  const ScalarField field(mesh, smooth_values(mesh, 3, 4));
  const core::MethodResult result = apply_fair(field, {});
  CHECK(result.parameters ==
        core::Parameters{{"extrema", std::int64_t{8}}, {"values", "ends"}, {"weights", "clamped"}});
  REQUIRE(result.details.size() == 6);
  CHECK(result.details[2] == core::Parameters::value_type{"extrema_left", std::int64_t{8}});
  const core::MethodResult many = apply_fair(field, {{"extrema", "100000"}});
  REQUIRE(many.details.size() == 7);
  CHECK(many.details[6].first == "note");
  for (const int threads : {1, 4}) {
    const core::ThreadLimit limit(threads);
    const core::MethodResult again = apply_fair(field, {});
    CHECK(
        std::equal(again.field.values().begin(), again.field.values().end(), result.field.values().begin()));
    CHECK(std::equal(again.field.ranks().begin(), again.field.ranks().end(), result.field.ranks().begin()));
  }
  std::vector<double> huge(field.values().begin(), field.values().end());
  for (double& value : huge) value = value * 1e308 - 0.5e308;
  const ScalarField large = apply_fair({mesh, huge}, {}).field;
  CHECK(std::equal(large.ranks().begin(), large.ranks().end(), result.field.ranks().begin()));
}
