#include "morsel/morse/critical_points.h"

#include <catch2/catch.hpp>

#include "morsel/core/parallel/parallel.h"
#include "support/fields.h"
#include "support/link_oracle.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using morse::CriticalPoints;
using morse::CriticalType;

TEST_CASE("height on the octahedron has one minimum and one maximum") {
  const CriticalPoints points = morse::classify({octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3}});
  REQUIRE(points.points.size() == 2);
  CHECK(points.points[0] == morse::CriticalPoint{0, CriticalType::maximum, 1});
  CHECK(points.points[1] == morse::CriticalPoint{1, CriticalType::minimum, 1});
}

TEST_CASE("a monkey saddle has multiplicity 2") {
  const CriticalPoints points = morse::classify({bipyramid(6).mesh(), {0, -9, 1, -1, 2, -2, 3, -3}});
  CHECK(points.minima == 1);
  const auto saddle = points.points.front();
  CHECK(saddle == morse::CriticalPoint{0, CriticalType::saddle, 2});
  CHECK(points.maxima == 3);
  CHECK(points.saddle_multiplicity == 2);
  CHECK(points.total() == 5);
}

TEST_CASE("a boundary vertex is never a maximum") {
  const CriticalPoints up = morse::classify({wheel(6).mesh(), {0, 1, 2, 3, 4, 5, 6}});
  CHECK(up.minima == 1);
  CHECK(up.maxima == 0);
  CHECK(up.saddle_multiplicity == 0);
  const CriticalPoints down = morse::classify({wheel(6).mesh(), {9, 1, 2, 3, 4, 5, 6}});
  CHECK(down.minima == 1);
  CHECK(down.maxima == 1);
  CHECK(down.saddle_multiplicity == 1);
}

TEST_CASE("Euler identity component by component for every field on every mesh") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 11)) {
      INFO(entry.name << ", " << f.name);
      const CriticalPoints points = morse::classify(f.field);
      std::vector<long> sum(entry.mesh.component_count(), 0);
      for (const auto& p : points.points)
        sum[entry.mesh.component_of_vertex(p.vertex)] +=
            p.type == CriticalType::saddle ? -long{p.multiplicity} : 1;
      for (Index c = 0; c < entry.mesh.component_count(); ++c)
        CHECK(sum[c] == entry.mesh.euler_characteristic(c));
    }
}

TEST_CASE("types and multiplicities are those of the links for every field on every mesh") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 12)) {
      INFO(entry.name << ", " << f.name);
      const auto links = link_components(entry.mesh, {f.field.values().begin(), f.field.values().end()});
      std::vector<morse::CriticalPoint> expected;
      for (Index v = 0; v < entry.mesh.vertex_count(); ++v) {
        const auto [lower, upper] = links[v];
        if (lower == 0)
          expected.push_back({v, CriticalType::minimum, 1});
        else if (upper == 0)
          expected.push_back({v, CriticalType::maximum, 1});
        else if (lower > 1)
          expected.push_back({v, CriticalType::saddle, static_cast<Index>(lower - 1)});
        if (lower > 0 && upper > 0) CHECK(lower == upper);
      }
      CHECK(morse::classify(f.field).points == expected);
    }
}

TEST_CASE("negating a field swaps minima and maxima on closed meshes") {
  for (const NamedMesh& entry : mesh_zoo()) {
    if (!entry.mesh.is_closed()) continue;
    for (const NamedField& f : field_zoo(entry.mesh, 13)) {
      INFO(entry.name << ", " << f.name);
      std::vector<morse::CriticalPoint> swapped = morse::classify(f.field.negated()).points;
      for (morse::CriticalPoint& p : swapped)
        if (p.type != CriticalType::saddle)
          p.type = p.type == CriticalType::minimum ? CriticalType::maximum : CriticalType::minimum;
      CHECK(swapped == morse::classify(f.field).points);
    }
  }
}

TEST_CASE("classification gives the same for every number of threads") {
  const TriangleMesh mesh = shuffled(sphere(5), 3).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 5));
  const CriticalPoints serial = [&] {
    const core::ThreadLimit one(1);
    return morse::classify(field);
  }();
  CHECK(serial.total() == serial.points.size());
  for (const int threads : {2, 7}) {
    const core::ThreadLimit limit(threads);
    CHECK(morse::classify(field).points == serial.points);
  }
}

/// classify() is classify_vertex() at every vertex, with fewer and more threads than counting has lanes.
static void check_vertex_by_vertex(const ScalarField& field) {
  std::vector<morse::CriticalPoint> expected;
  for (Index v = 0; v < field.mesh().vertex_count(); ++v)
    if (const auto point = morse::classify_vertex(field, v); point.type != CriticalType::regular)
      expected.push_back(point);
  for (const int threads : {1, 3, 16}) {
    const core::ThreadLimit limit(threads);
    const CriticalPoints points = morse::classify(field);
    CHECK(points.points == expected);
    CHECK(points.total() == expected.size());
  }
}

TEST_CASE("all vertices at once are classified as one by one") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {14u, 15u, 16u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << ", " << f.name << ", seed " << seed);
        check_vertex_by_vertex(f.field);
      }
  check_vertex_by_vertex({shuffled(torus(60, 70), 3).mesh(), random_values(60 * 70, 17)});
}

TEST_CASE("any number of runs of lower neighbours is counted") {
  for (const int sides : {62, 63, 64, 126, 127, 128, 254, 255, 256, 510, 512, 600, 10000, 10001})
    for (const int lows : {1, sides / 3, sides / 2})
      for (const Soup& soup : {bipyramid(sides), wheel(sides), shuffled(bipyramid(sides), 5)}) {
        INFO(sides << " sides, " << lows << " runs");
        const TriangleMesh mesh = soup.mesh();
        std::vector<double> values(mesh.vertex_count(), 0);
        for (int i = 0; i < sides; ++i)
          values[values.size() - 1 - static_cast<std::size_t>(i)] = i % 2 == 0 && i < 2 * lows ? -1 : 1;
        check_vertex_by_vertex({mesh, std::move(values)});
      }
}

TEST_CASE("classification can be cancelled") {
  std::stop_source stop;
  stop.request_stop();
  const ScalarField field(octahedron().mesh(), {1, -1, 0, 0.1, 0.2, 0.3});
  CHECK_THROWS_AS(morse::classify(field, core::Progress({}, stop.get_token())), core::Cancelled);
}
