#include "morsel/mscomplex/segmentation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "support/complex_oracle.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::ScalarField;
using mscomplex::DiscreteGradient;
using mscomplex::segment;
using mscomplex::Segmentation;
using mscomplex::SegmentLabels;

namespace {

/// Tops in the oracle's terms: critical triangles, then the smallest vertices of loops.
std::vector<Cell> top_cells(const DiscreteGradient& gradient) {
  const TriangleMesh& mesh = gradient.mesh();
  std::vector<Cell> cells;
  for (const auto& m : gradient.maxima()) cells.push_back(triangle_cell(mesh, m.cell));
  for (Index k = 0; k < mesh.boundary_loop_count(); ++k)
    cells.push_back({mesh.origin(mesh.boundary_loop(k).front())});
  return cells;
}

/// What holds for every segmentation, whatever the labels.
void check_labels(const Segmentation& s, const DiscreteGradient& gradient) {
  const TriangleMesh& mesh = gradient.mesh();
  for (const SegmentLabels* labels : {&s.ascending, &s.descending, &s.morse_smale}) {
    REQUIRE(labels->vertex.size() == mesh.vertex_count());
    REQUIRE(labels->triangle.size() == mesh.triangle_count());
    const std::set<Index> carried(labels->triangle.begin(), labels->triangle.end());
    CHECK(labels->count == carried.size());
  }
  const auto minima = gradient.minima().size();
  const auto tops = gradient.maxima().size() + mesh.boundary_loop_count();
  CHECK(s.ascending.count == minima);
  CHECK(s.descending.count <= tops);
  for (const Index label : s.ascending.vertex) REQUIRE(label < minima);
  for (const Index label : s.descending.vertex) REQUIRE(label < tops);
  CHECK(s.morse_smale.count <= s.cells.size());
  const auto first_of_vertices = s.cells.begin() + s.morse_smale.count;
  CHECK(std::is_sorted(s.cells.begin(), first_of_vertices));
  CHECK(std::is_sorted(first_of_vertices, s.cells.end()));
  CHECK(std::set(s.cells.begin(), s.cells.end()).size() == s.cells.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    REQUIRE(s.morse_smale.triangle[t] < s.morse_smale.count);
    REQUIRE(s.cells[s.morse_smale.triangle[t]] ==
            std::array{s.ascending.triangle[t], s.descending.triangle[t]});
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    REQUIRE(s.cells.at(s.morse_smale.vertex[v]) == std::array{s.ascending.vertex[v], s.descending.vertex[v]});
  for (std::size_t i = 0; i < minima; ++i) CHECK(s.ascending.vertex[gradient.minima()[i]] == i);
  for (std::size_t i = 0; i < gradient.maxima().size(); ++i) {
    CHECK(s.descending.triangle[gradient.maxima()[i].cell] == i);
    CHECK(s.descending.vertex[gradient.maxima()[i].vertex] == i);
  }
}

bool same_bits(const SegmentLabels& a, const SegmentLabels& b) {
  return a.vertex == b.vertex && a.triangle == b.triangle && a.count == b.count;
}

}  // namespace

TEST_CASE("segments around a monkey saddle") {
  const TriangleMesh mesh = bipyramid(6).mesh();
  const ScalarField field(mesh, {0, -9, 1, -1, 2, -2, 3, -3});
  const DiscreteGradient gradient(field);
  const Segmentation s = segment(field, gradient);
  check_labels(s, gradient);
  CHECK(s.ascending.count == 1);
  CHECK(s.descending.count == 3);
  CHECK(s.morse_smale.count == 3);
  // Maxima 2, 4 and 6; the others take the highest triangle they touch.
  CHECK(s.descending.vertex == std::vector<Index>{2, 2, 0, 1, 1, 2, 2, 2});
}

TEST_CASE("one triangle is one segment of each kind") {
  const ScalarField field(single_triangle().mesh(), {2, 0, 1});
  const Segmentation s = segment(field, DiscreteGradient(field));
  CHECK(s.ascending.count == 1);
  CHECK(s.descending.count == 1);
  CHECK(s.morse_smale.count == 1);
  CHECK(s.morse_smale.vertex == std::vector<Index>{0, 0, 0});
}

TEST_CASE("a cap that no triangle flows into has no segment") {
  // The inner loop of an annulus is its lowest ring: its edges are paired with its vertices, but for a
  // saddle's.
  const ScalarField field(annulus(3, 2).mesh(), {0, 1, 2, 3, 4, 5});
  const Segmentation s = segment(field, DiscreteGradient(field));
  CHECK(s.descending.count == 1);
  CHECK(s.descending.vertex == std::vector<Index>(6, 1));
}

TEST_CASE("segments are those of plain tracing") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const unsigned seed : {71u, 72u})
      for (const NamedField& f : field_zoo(entry.mesh, seed)) {
        INFO(entry.name << " | " << f.name << " | seed " << seed);
        const TriangleMesh& mesh = entry.mesh;
        const DiscreteGradient gradient(f.field);
        const Segmentation s = segment(f.field, gradient);
        check_labels(s, gradient);
        const ComplexOracle oracle(f.field);
        const std::vector<Cell> tops = top_cells(gradient);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          REQUIRE(gradient.minima()[s.ascending.vertex[v]] == oracle.way_down(v).back());
          REQUIRE(tops[s.descending.vertex[v]] == oracle.top_of_vertex(v));
        }
        for (Index t = 0; t < mesh.triangle_count(); ++t) {
          const Cell triangle = triangle_cell(mesh, t);
          REQUIRE(gradient.minima()[s.ascending.triangle[t]] == oracle.minimum_of_triangle(triangle));
          REQUIRE(tops[s.descending.triangle[t]] == oracle.top(triangle));
        }
      }
}

TEST_CASE("segments at vertices of degree ten thousand") {
  for (const TriangleMesh& mesh : {wheel(10000).mesh(), bipyramid(10000).mesh()})
    for (const NamedField& f : field_zoo(mesh, 73)) {
      INFO(mesh.vertex_count() << " vertices | " << f.name);
      const DiscreteGradient gradient(f.field);
      check_labels(segment(f.field, gradient), gradient);
    }
}

TEST_CASE("segments are the same for every number of threads") {
  const TriangleMesh mesh = punctured_sphere(5, 5).mesh();
  for (const NamedField& f : field_zoo(mesh, 74)) {
    INFO(f.name);
    const DiscreteGradient gradient(f.field);
    const auto segments_with = [&](int threads) {
      core::ThreadLimit limit(threads);
      return segment(f.field, gradient);
    };
    const Segmentation one = segments_with(1);
    for (const int threads : {2, 7}) {
      const Segmentation many = segments_with(threads);
      CHECK(same_bits(one.ascending, many.ascending));
      CHECK(same_bits(one.descending, many.descending));
      CHECK(same_bits(one.morse_smale, many.morse_smale));
      CHECK(one.cells == many.cells);
    }
  }
}

TEST_CASE("segments refuse the gradient of another mesh") {
  const ScalarField field(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  const ScalarField other(octahedron().mesh(), {9, -9, 1, 2, 3, 4});
  CHECK_THROWS_AS(segment(field, DiscreteGradient(other)), core::InvalidArgument);
}
