#include "morsel/morse/unfolding.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "morsel/morse/critical_points.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;

TEST_CASE("a monkey saddle is unfolded into two saddles") {
  const TriangleMesh mesh = wheel(6).mesh();
  const ScalarField field(mesh, {0, 1, -1, 2, -2, 3, -3});
  REQUIRE(morse::classify_vertex(field, 0).multiplicity == 2);
  const auto unfolded = morse::unfold_saddle(field, 0);
  REQUIRE(unfolded);
  CHECK(unfolded->change == 1);
  CHECK(unfolded->field.value(0) == 1);
  CHECK(unfolded->field.rank(0) == unfolded->field.rank(1) + 1);
  const morse::CriticalPoints points = morse::classify(unfolded->field);
  CHECK(points.saddles == 2);
  CHECK(points.saddle_multiplicity == 2);
  CHECK(points.minima == 3);
  CHECK_FALSE(morse::unfold_saddle(unfolded->field, 0));
  CHECK_FALSE(morse::unfold_saddle(field, 1));
}

TEST_CASE("unfolding adds one saddle and moves one vertex by the least change") {
  int unfolded_saddles = 0;
  for (const auto& [name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 6)) {
      INFO(name << ", " << field_name);
      const morse::CriticalPoints before = morse::classify(field);
      int tried = 0;
      for (const morse::CriticalPoint& point : before.points) {
        if (point.multiplicity < 2 || ++tried > 4) continue;
        const auto unfolded = morse::unfold_saddle(field, point.vertex);
        // By brute force: every position in the order next to a neighbour, tried on the whole field.
        double least = HUGE_VAL;
        std::vector<Index> ring;
        mesh.neighbors(point.vertex, ring);
        for (const Index u : ring) {
          std::vector<Index> order(field.order().begin(), field.order().end());
          std::erase(order, point.vertex);
          const bool up = field.is_lower(point.vertex, u);
          order.insert(std::find(order.begin(), order.end(), u) + (up ? 1 : 0), point.vertex);
          core::FlatArray<Index> rank(order.size());
          for (std::size_t r = 0; r < order.size(); ++r) rank[order[r]] = static_cast<Index>(r);
          std::vector<double> values(field.values().begin(), field.values().end());
          values[point.vertex] = values[u];
          const morse::CriticalPoints after = morse::classify({mesh, values, std::move(rank)});
          if (after.minima == before.minima && after.maxima == before.maxima &&
              after.saddles == before.saddles + 1)
            least = std::min(least, std::abs(field.value(u) - field.value(point.vertex)));
        }
        REQUIRE(unfolded.has_value() == std::isfinite(least));
        if (!unfolded) continue;
        ++unfolded_saddles;
        CHECK(unfolded->change == least);
        const morse::CriticalPoints after = morse::classify(unfolded->field);
        CHECK(after.total() == before.total() + 1);
        CHECK(after.minima == before.minima);
        CHECK(after.saddle_multiplicity == before.saddle_multiplicity);
        for (Index v = 0; v < mesh.vertex_count(); ++v)
          if (v != point.vertex) REQUIRE(unfolded->field.value(v) == field.value(v));
      }
    }
  CHECK(unfolded_saddles > 20);
}
