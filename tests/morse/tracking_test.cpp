#include "morsel/morse/tracking.h"

#include <catch2/catch.hpp>
#include <map>

#include "morsel/core/parallel/parallel.h"
#include "morsel/morse/smoothing/diffusion.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using core::ScalarField;
using morse::CriticalPointTracker;
using morse::CriticalType;

namespace {

/// Bumps of width 1 on a grid of unit squares; positive ones are maxima.
ScalarField bumps(const TriangleMesh& mesh, const std::vector<std::pair<Point, double>>& list) {
  std::vector<double> values;
  for (const Point& p : mesh.positions()) {
    double sum = 1e-3 * p.x() + 1e-4 * p.y();
    for (const auto& [center, height] : list) sum += height * std::exp(-(p - center).squaredNorm());
    values.push_back(sum);
  }
  return {mesh, values};
}

/// Vertex of the last field to vertex of the first.
std::map<Index, Index> origins(const CriticalPointTracker& tracker, CriticalType type) {
  std::map<Index, Index> result;
  for (std::size_t i = 0; i < tracker.points().points.size(); ++i)
    if (tracker.points().points[i].type == type)
      result[tracker.points().points[i].vertex] = tracker.origins()[i];
  return result;
}

Index vertex_at(const TriangleMesh& mesh, double x, double y) {
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if ((mesh.position(v) - Point(x, y, mesh.position(v).z())).norm() < 1e-9) return v;
  throw std::out_of_range("no vertex there");
}

}  // namespace

TEST_CASE("critical points of a field come from themselves") {
  for (const auto& [name, mesh] : mesh_zoo())
    for (const auto& [field_name, field] : field_zoo(mesh, 2)) {
      INFO(name << ", " << field_name);
      CriticalPointTracker tracker(field, 0);
      tracker.advance(field);
      REQUIRE(tracker.points().points == morse::classify(field).points);
      for (std::size_t i = 0; i < tracker.origins().size(); ++i)
        CHECK(tracker.origins()[i] == tracker.points().points[i].vertex);
    }
}

TEST_CASE("a peak that moves is followed from field to field") {
  const TriangleMesh mesh = grid(24, 12).mesh();
  const double step = mesh.position(1).x() - mesh.position(0).x();
  REQUIRE(step == Approx(1));
  CriticalPointTracker tracker(bumps(mesh, {{{4, 6, 0}, 1}, {{18, 6, 0}, -1}}), 2);
  for (int x = 5; x <= 12; ++x)
    tracker.advance(bumps(mesh, {{{static_cast<double>(x), 6, 0}, 1}, {{18, 6, 0}, -1}}));
  const auto maxima = origins(tracker, CriticalType::maximum);
  REQUIRE(maxima.contains(vertex_at(mesh, 12, 6)));
  CHECK(maxima.at(vertex_at(mesh, 12, 6)) == vertex_at(mesh, 4, 6));
  const auto minima = origins(tracker, CriticalType::minimum);
  CHECK(minima.at(vertex_at(mesh, 18, 6)) == vertex_at(mesh, 18, 6));
}

TEST_CASE("peaks that separate share their origin and one at the boundary has none") {
  const TriangleMesh mesh = grid(24, 12).mesh();
  CriticalPointTracker tracker(bumps(mesh, {{{8, 6, 0}, 1}}), 3);
  tracker.advance(bumps(mesh, {{{8, 6, 0}, 1}, {{9, 6, 0}, 0.1}, {{8, 8, 0}, 1}, {{20, 6, 0}, 1}}));
  const auto maxima = origins(tracker, CriticalType::maximum);
  CHECK(maxima.at(vertex_at(mesh, 8, 6)) == vertex_at(mesh, 8, 6));
  CHECK(maxima.at(vertex_at(mesh, 8, 8)) == vertex_at(mesh, 8, 6));
  CHECK(maxima.at(vertex_at(mesh, 20, 6)) == kNone);  // uphill from there lay the boundary
  CriticalPointTracker shorter(bumps(mesh, {{{8, 6, 0}, 1}}), 1.5);
  shorter.advance(bumps(mesh, {{{8, 6, 0}, 1}, {{8, 8, 0}, 1}}));
  CHECK(origins(shorter, CriticalType::maximum).at(vertex_at(mesh, 8, 8)) == kNone);  // a new one on its side
}

TEST_CASE("saddles come from the nearest saddle within reach") {
  const TriangleMesh mesh = grid(24, 12).mesh();
  const ScalarField before = bumps(mesh, {{{6, 6, 0}, 1}, {{9, 6, 0}, 1}});
  const ScalarField after = bumps(mesh, {{{6, 6, 0}, 1}, {{10, 6, 0}, 1}});
  for (const double reach : {0.5, 3.0}) {
    CriticalPointTracker tracker(before, reach);
    tracker.advance(after);
    for (std::size_t i = 0; i < tracker.points().points.size(); ++i) {
      const morse::CriticalPoint& point = tracker.points().points[i];
      if (point.type != CriticalType::saddle) continue;
      Index expected = kNone;  // by brute force, for distances of unit and diagonal edges
      double best = reach;
      std::vector<double> distance(mesh.vertex_count(), 1e9);
      distance[point.vertex] = 0;
      for (int round = 0; round < 24; ++round)
        for (Index e = 0; e < mesh.edge_count(); ++e) {
          const auto [a, b] = mesh.edge_vertices(e);
          const double length = (mesh.position(a) - mesh.position(b)).norm();
          distance[a] = std::min(distance[a], distance[b] + length);
          distance[b] = std::min(distance[b], distance[a] + length);
        }
      for (const morse::CriticalPoint& other : morse::classify(before).points)
        if (other.type == CriticalType::saddle && distance[other.vertex] <= best) {
          if (expected == kNone || distance[other.vertex] < best) expected = other.vertex;
          best = distance[other.vertex];
        }
      CHECK(tracker.origins()[i] == expected);
    }
  }
}

TEST_CASE("origins are critical points of the input of the same type at any number of threads") {
  for (const auto& [name, zoo_mesh] : mesh_zoo()) {
    INFO(name);
    const auto& mesh = zoo_mesh;  // which lambdas can capture
    const ScalarField input(mesh, random_values(mesh.vertex_count(), 8));
    const morse::ExplicitDiffusion diffusion(mesh, morse::EdgeWeights::uniform, 0.5);
    const auto follow = [&] {
      CriticalPointTracker tracker(input, mesh.bounding_box().diagonal());
      std::vector<double> values(input.values().begin(), input.values().end());
      for (int i = 0; i < 6; ++i) {
        values = diffusion.step(values);
        tracker.advance({mesh, values});
      }
      return tracker;
    };
    const CriticalPointTracker tracker = follow();
    std::vector<CriticalType> types(mesh.vertex_count(), CriticalType::regular);
    for (const auto& point : morse::classify(input).points) types[point.vertex] = point.type;
    for (std::size_t i = 0; i < tracker.origins().size(); ++i)
      if (tracker.origins()[i] != kNone)
        CHECK(types[tracker.origins()[i]] == tracker.points().points[i].type);
    const core::ThreadLimit limit(4);
    const CriticalPointTracker again = follow();
    CHECK(std::equal(again.origins().begin(), again.origins().end(), tracker.origins().begin(),
                     tracker.origins().end()));
  }
}
