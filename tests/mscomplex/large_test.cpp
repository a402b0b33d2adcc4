// Real meshes, and more extrema than 16 bits count.

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/critical_points.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/mscomplex/segmentation.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::MorseSmaleComplex;
using mscomplex::segment;
using mscomplex::Segmentation;

namespace {

ScalarField height(const TriangleMesh& mesh, int axis) {
  std::vector<double> values;
  for (const Point& p : mesh.positions()) values.push_back(p[axis]);
  return {mesh, std::move(values)};
}

/// A field as rough as noise: the distance of each vertex from the mean of its neighbours, outward or inward.
ScalarField roughness(const TriangleMesh& mesh) {
  std::vector<double> values;
  std::vector<Index> ring;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    mesh.neighbors(v, ring);
    Point sum = Point::Zero();
    for (const Index u : ring) sum += mesh.position(u);
    Point normal = Point::Zero();
    mesh.for_each_outgoing(v, [&](Index h) {
      normal += (mesh.position(mesh.target(h)) - mesh.position(v))
                    .cross(mesh.position(mesh.apex(h)) - mesh.position(v));
    });
    values.push_back((mesh.position(v) - sum / static_cast<double>(ring.size())).dot(normal.normalized()));
  }
  return {mesh, std::move(values)};
}

/// Minima, saddles, maxima, caps, arcs, quads; descending, ascending and Morse-Smale segments.
std::vector<Index> measure(const ScalarField& field) {
  const MorseSmaleComplex complex(field);
  complex.gradient().validate(field);
  complex.validate();
  const morse::CriticalPoints points = morse::classify(field);
  CHECK(complex.minimum_count() == points.minima);
  CHECK(complex.saddle_count() == points.saddle_multiplicity);
  CHECK(complex.maximum_count() == points.maxima);
  const Segmentation s = segment(field, complex.gradient());
  const auto& mesh = field.mesh();
  Index wrong = 0;
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    if (s.cells.at(s.morse_smale.triangle[t]) !=
        std::array{s.ascending.triangle[t], s.descending.triangle[t]})
      ++wrong;
  CHECK(wrong == 0);
  return {complex.minimum_count(), complex.saddle_count(), complex.maximum_count(),
          complex.cap_count(),     complex.arc_count(),    complex.quad_count(),
          s.descending.count,      s.ascending.count,      s.morse_smale.count};
}

}  // namespace

TEST_CASE("the complex of the lion head") {
  const TriangleMesh mesh = core::read_mesh(sample("lion-head.off")).mesh;
  CHECK(measure(height(mesh, 2)) == std::vector<Index>{8, 15, 8, 1, 60, 30, 8, 8, 20});
  CHECK(measure(roughness(mesh)) == std::vector<Index>{492, 904, 413, 1, 3616, 1808, 414, 492, 1747});
}

TEST_CASE("the complex of the bunny") {
  const TriangleMesh mesh = core::read_mesh(sample("bunny00.off")).mesh;
  CHECK(measure(height(mesh, 1)) == std::vector<Index>{33, 49, 18, 0, 196, 98, 18, 33, 98});
  CHECK(measure(roughness(mesh)) == std::vector<Index>{3754, 6752, 3000, 0, 27008, 13504, 3000, 3754, 13074});
}

TEST_CASE("more than 65536 minima and maxima") {
  // Three colours on a triangular lattice: low, high and in between, where six neighbours alternate.
  constexpr int kSide = 450;
  const TriangleMesh mesh = torus(kSide, kSide).mesh();
  std::vector<double> values = random_values(mesh.vertex_count(), 81);
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      static constexpr double kLevel[] = {0, 4, 2};
      values[static_cast<std::size_t>(i * kSide + j)] += kLevel[(i + j) % 3];
    }
  const ScalarField field(mesh, values);
  const std::vector<Index> counts = measure(field);
  constexpr Index kThird = kSide * kSide / 3;
  CHECK(counts[0] == kThird);
  CHECK(counts[1] == 2 * kThird);
  CHECK(counts[2] == kThird);
  CHECK(counts[8] > 2 * kThird);
}
