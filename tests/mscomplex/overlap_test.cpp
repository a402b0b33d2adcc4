#include "morsel/mscomplex/overlap.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/mscomplex/segmentation.h"
#include "support/fields.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using mscomplex::Overlap;
using mscomplex::overlaps;
using mscomplex::OverlapTable;

namespace {

std::vector<Index> random_labels(std::size_t triangles, Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> labels(triangles);
  for (Index& label : labels) label = static_cast<Index>(random() % count);
  return labels;
}

/// The table from a plain map, which sums in the order of the triangles too.
OverlapTable plain_overlaps(const std::vector<Index>& labels, Index count, const std::vector<Index>& others,
                            const std::vector<double>& areas) {
  std::map<std::pair<Index, Index>, double> sums;
  for (std::size_t t = 0; t < labels.size(); ++t) sums[{labels[t], others[t]}] += areas[t];
  OverlapTable table;
  table.offset.assign(count + 1, 0);
  for (const auto& [pair, area] : sums) {
    ++table.offset[pair.first + 1];
    table.entries.push_back({pair.second, area});
  }
  for (Index i = 0; i < count; ++i) table.offset[i + 1] += table.offset[i];
  return table;
}

bool same(const OverlapTable& a, const OverlapTable& b) {
  return a.offset == b.offset && a.entries == b.entries;
}

}  // namespace

TEST_CASE("overlaps of drawn labels") {
  const std::vector<double> areas = {1, 2, 4, 8, 16};
  const std::vector<Index> fine = {0, 0, 1, 3, 3};  // nothing carries 2
  const std::vector<Index> coarse = {0, 1, 1, 1, 0};
  const OverlapTable table = overlaps(fine, 4, coarse, 2, areas);
  CHECK(table.offset == std::vector<std::size_t>{0, 2, 3, 3, 5});
  CHECK(table.entries == std::vector<Overlap>{{0, 1}, {1, 2}, {1, 4}, {0, 16}, {1, 8}});
  CHECK(largest_overlaps(table) == std::vector<Overlap>{{1, 2}, {1, 4}, {core::kNone, 0}, {0, 16}});
  const OverlapTable back = transposed(table, 2);
  CHECK(back.offset == std::vector<std::size_t>{0, 2, 5});
  CHECK(back.entries == std::vector<Overlap>{{0, 1}, {3, 16}, {0, 2}, {1, 4}, {3, 8}});
  CHECK(largest_overlaps(back) == std::vector<Overlap>{{3, 16}, {3, 8}});
  CHECK(mscomplex::segment_areas(fine, 4, areas) == std::vector<double>{3, 4, 0, 24});
}

TEST_CASE("of equally large overlaps the smallest number counts") {
  const OverlapTable table =
      overlaps(std::vector<Index>{0, 0, 0}, 1, std::vector<Index>{7, 3, 5}, 8, std::vector<double>{1, 2, 2});
  CHECK(largest_overlaps(table) == std::vector<Overlap>{{3, 2}});
  // Triangles without area still belong together.
  CHECK(largest_overlaps(overlaps(std::vector<Index>{0, 0}, 1, std::vector<Index>{2, 1}, 3,
                                  std::vector<double>{0, 0})) == std::vector<Overlap>{{1, 0}});
}

TEST_CASE("areas of triangles") {
  CHECK(mscomplex::triangle_areas(square_pair().mesh()) == std::vector<double>{0.5, 0.5});
  const TriangleMesh mesh = octahedron().mesh();
  for (const double area : mscomplex::triangle_areas(mesh)) CHECK(area == Approx(std::sqrt(3.0) / 2));
}

TEST_CASE("overlaps are those of a plain map, to the bit, at any number of threads") {
  const TriangleMesh mesh = torus(120, 70).mesh();
  const std::vector<double> areas = mscomplex::triangle_areas(mesh);
  for (const auto& [count, other_count] :
       {std::pair<Index, Index>{1, 1}, {3, 2}, {40, 900}, {15000, 15000}}) {
    INFO(count << " and " << other_count << " segments");
    const std::vector<Index> labels = random_labels(areas.size(), count, 81);
    const std::vector<Index> others = random_labels(areas.size(), other_count, 82);
    const OverlapTable plain = plain_overlaps(labels, count, others, areas);
    for (const int threads : {1, 2, 7}) {
      const core::ThreadLimit limit(threads);
      const OverlapTable table = overlaps(labels, count, others, other_count, areas);
      CHECK(same(table, plain));
      CHECK(same(transposed(table, other_count), overlaps(others, other_count, labels, count, areas)));
      CHECK(same(transposed(transposed(table, other_count), count), table));
    }
  }
}

TEST_CASE("pairs of segments may be more than 32 bits count") {
  const Index many = 300'000;
  const OverlapTable table = overlaps(std::vector<Index>{many - 1, 0, many - 1}, many,
                                      std::vector<Index>{many - 1, 5, 5}, many, std::vector<double>{1, 2, 4});
  CHECK(table.entries == std::vector<Overlap>{{5, 2}, {5, 4}, {many - 1, 1}});
  CHECK(table.of(0).size() == 1);
  CHECK(table.of(many - 1).size() == 2);
}

TEST_CASE("a Morse-Smale segment lies in its minimum's and its maximum's") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 83)) {
      INFO(entry.name << " | " << f.name);
      const std::vector<double> areas = mscomplex::triangle_areas(entry.mesh);
      const mscomplex::DiscreteGradient gradient(f.field);
      const mscomplex::Segmentation s = mscomplex::segment(f.field, gradient);
      const Index tops = static_cast<Index>(gradient.maxima().size()) + entry.mesh.boundary_loop_count();
      const OverlapTable table =
          overlaps(s.morse_smale.triangle, s.morse_smale.count, s.descending.triangle, tops, areas);
      const std::vector<double> whole =
          mscomplex::segment_areas(s.morse_smale.triangle, s.morse_smale.count, areas);
      const std::vector<Overlap> largest = largest_overlaps(table);
      for (Index i = 0; i < s.morse_smale.count; ++i) {
        REQUIRE(table.of(i).size() == 1);
        REQUIRE(largest[i] == Overlap{s.cells[i][1], whole[i]});
      }
    }
}

TEST_CASE("labels that do not fit are refused") {
  const std::vector<Index> labels = {0, 1};
  const std::vector<double> areas = {1, 1};
  CHECK_THROWS_AS(overlaps(labels, 1, labels, 2, areas), core::InvalidArgument);
  CHECK_THROWS_AS(overlaps(labels, 2, labels, 1, areas), core::InvalidArgument);
  CHECK_THROWS_AS(overlaps(labels, 2, std::vector<Index>{0}, 2, areas), core::InvalidArgument);
  CHECK_THROWS_AS(overlaps(labels, 2, labels, 2, std::vector<double>{1}), core::InvalidArgument);
  CHECK_THROWS_AS(mscomplex::segment_areas(labels, 1, areas), core::InvalidArgument);
  CHECK_THROWS_AS(transposed(overlaps(labels, 2, labels, 2, areas), 1), core::InvalidArgument);
}
