#include "morsel/mscomplex/segments.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/union_find.h"
#include "morsel/mscomplex/quad_regions.h"
#include "support/fields.h"
#include "support/mean_curvature.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using core::ScalarField;
using mscomplex::DiscreteGradient;
using mscomplex::MorseSmaleComplex;
using mscomplex::NodeKind;
using mscomplex::PersistenceHierarchy;
using mscomplex::Segmenter;
using mscomplex::SegmentKind;
using mscomplex::Segments;

namespace {

/// For each triangle, the smallest that can be reached from it through triangles of its label.
std::vector<Index> pieces(const TriangleMesh& mesh, const std::vector<Index>& label, bool across_edges) {
  core::UnionFind sets(mesh.triangle_count());
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index t = TriangleMesh::triangle_of(h);
    const Index across = mesh.twin(h);
    if (across != kNone && label[t] == label[TriangleMesh::triangle_of(across)])
      sets.unite(t, TriangleMesh::triangle_of(across));
  }
  for (Index v = 0; !across_edges && v < mesh.vertex_count(); ++v) {
    std::map<Index, Index> seen;  // label to a triangle
    mesh.for_each_outgoing(v, [&](Index h) {
      const Index t = TriangleMesh::triangle_of(h);
      sets.unite(t, seen.try_emplace(label[t], t).first->second);
    });
  }
  std::vector<Index> smallest(mesh.triangle_count());
  for (Index t = 0; t < smallest.size(); ++t) smallest[t] = sets.find(t);
  return smallest;
}

/// The stretches of the discs' rims by joining corners that lie on the same one, whatever the gradient; for
/// each triangle, that of its lowest corner. Corners of caps come after the triangles', by the half-edge that
/// leaves them.
std::vector<Index> stretches(const ScalarField& field, const DiscreteGradient& gradient) {
  const TriangleMesh& mesh = field.mesh();
  core::UnionFind corners(2 * mesh.halfedge_count());
  std::vector<Index> out_of(mesh.vertex_count(), kNone);  // the boundary half-edge that leaves a vertex
  for (Index h = 0; h < mesh.halfedge_count(); ++h)
    if (mesh.twin(h) == kNone) out_of[mesh.origin(h)] = h;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index e = mesh.edge(h);
    const Index across = mesh.twin(h);
    // The corners at both ends of the edge, on this side and on the other.
    const std::array here = {h, TriangleMesh::next(h)};
    const std::array there = {
        across == kNone ? mesh.halfedge_count() + out_of[mesh.origin(h)] : TriangleMesh::next(across),
        across == kNone ? mesh.halfedge_count() + out_of[mesh.target(h)] : across};
    if (gradient.paired_vertex(e) != kNone) {
      corners.unite(here[0], here[1]);
      corners.unite(there[0], there[1]);
    } else if (gradient.paired_triangle(e) != kNone) {
      corners.unite(here[0], there[0]);
      corners.unite(here[1], there[1]);
    }
  }
  std::vector<Index> label(mesh.triangle_count());
  for (Index h = 0; h < mesh.halfedge_count(); ++h)
    if (field.is_lower(mesh.origin(h), mesh.target(h)) && field.is_lower(mesh.origin(h), mesh.apex(h)))
      label[h / 3] = corners.find(h);
  return label;
}

/// Whether two labellings are the same partition.
bool same_partition(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::map<Index, Index> there, back;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (there.try_emplace(a[i], b[i]).first->second != b[i] ||
        back.try_emplace(b[i], a[i]).first->second != a[i])
      return false;
  return a.size() == b.size();
}

/// The labels of triangles by the gradient of the level, connected or not.
std::vector<Index> traced_labels(const ScalarField& field, const DiscreteGradient& gradient,
                                 SegmentKind kind) {
  const mscomplex::Segmentation traced = segment(field, gradient);
  if (kind == SegmentKind::morse_smale) return stretches(field, gradient);
  return (kind == SegmentKind::ascending ? traced.ascending : traced.descending).triangle;
}

double edge_length(const TriangleMesh& mesh, Index e) {
  const auto [a, b] = mesh.edge_vertices(e);
  return (mesh.position(a) - mesh.position(b)).norm();
}

/// Sizes and borders by brute force.
void check_measures(const TriangleMesh& mesh, const Segments& s) {
  std::vector<double> area(s.count(), 0), boundary(s.count(), 0), mesh_boundary(s.count(), 0);
  std::vector<Index> triangles(s.count(), 0), vertices(s.count(), 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    ++triangles[s.triangle[t]];
    area[s.triangle[t]] +=
        0.5 * (mesh.position(b) - mesh.position(a)).cross(mesh.position(c) - mesh.position(a)).norm();
  }
  for (const Index label : s.vertex) ++vertices[label];
  std::map<std::pair<Index, Index>, std::pair<Index, double>> border;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index here = s.triangle[h / 3];
    const Index there = mesh.twin(h) == kNone ? kNone : s.triangle[mesh.twin(h) / 3];
    if (here == there) continue;
    const double length = edge_length(mesh, mesh.edge(h));
    boundary[here] += length;
    if (there == kNone) {
      mesh_boundary[here] += length;
    } else {
      ++border[{here, there}].first;
      border[{here, there}].second += length;
    }
  }
  std::size_t neighbours = 0;
  for (Index i = 0; i < s.count(); ++i) {
    const mscomplex::Segment& segment = s.segments[i];
    REQUIRE(segment.triangles == triangles[i]);
    REQUIRE(segment.triangles > 0);
    REQUIRE(segment.vertices == vertices[i]);
    REQUIRE(segment.area == Approx(area[i]));
    REQUIRE(segment.boundary_length == Approx(boundary[i]));
    REQUIRE(segment.mesh_boundary_length == Approx(mesh_boundary[i]));
    Index previous = kNone;
    for (const mscomplex::SegmentNeighbour& n : s.neighbours(i)) {
      REQUIRE((previous == kNone || previous < n.segment));
      previous = n.segment;
      REQUIRE(border.count({i, n.segment}) == 1);
      REQUIRE(n.edges == border[{i, n.segment}].first);
      REQUIRE(n.length == Approx(border[{i, n.segment}].second));
      const auto others = s.neighbours(n.segment);
      const auto mirrored =
          std::find_if(others.begin(), others.end(), [&](const auto& other) { return other.segment == i; });
      REQUIRE(mirrored != others.end());
      REQUIRE(mirrored->length == n.length);
      REQUIRE(mirrored->edges == n.edges);
      ++neighbours;
    }
  }
  REQUIRE(neighbours == border.size());
}

/// The saddles that are listed, against the ends of all arcs at the level.
void check_saddles(const PersistenceHierarchy& hierarchy, const Segments& s) {
  const MorseSmaleComplex& complex = hierarchy.complex();
  std::map<std::array<Index, 2>, std::set<Index>>
      joined;  // minimum and top, kNone as in segments; saddle vertices
  for (Index i = 0; i < complex.saddle_count(); ++i) {
    if (!hierarchy.is_alive(complex.saddle_node(i), s.level)) continue;
    const Index v = complex.node(complex.saddle_node(i)).vertex;
    for (const Index down : {4 * i, 4 * i + 2})
      for (const Index up : {4 * i + 1, 4 * i + 3}) {
        const bool has_minimum = s.kind != SegmentKind::descending;
        const bool has_top = s.kind != SegmentKind::ascending;
        joined[{has_minimum ? hierarchy.arc_end(down, s.level) : kNone,
                has_top ? hierarchy.arc_end(up, s.level) : kNone}]
            .insert(v);
      }
  }
  std::map<std::array<Index, 2>, std::set<Index>> listed;
  for (Index i = 0; i < s.count(); ++i) {
    const auto saddles = s.saddles(i);
    REQUIRE(std::is_sorted(saddles.begin(), saddles.end()));
    REQUIRE(std::adjacent_find(saddles.begin(), saddles.end()) == saddles.end());
    const std::array ends = {s.segments[i].minimum, s.segments[i].top};
    for (const Index v : saddles) REQUIRE(joined[ends].count(v) == 1);
    const bool is_cap = ends[1] != kNone && complex.kind(ends[1]) == NodeKind::cap;
    if (s.kind == SegmentKind::morse_smale) {
      REQUIRE(saddles.size() <= 2);
      if (!is_cap && !joined[ends].empty()) REQUIRE(!saddles.empty());
    } else if (!is_cap) {
      REQUIRE(joined[ends] == std::set(saddles.begin(), saddles.end()));
    }
  }
}

void check_level(const ScalarField& field, const Segmenter& segmenter, Index level) {
  const TriangleMesh& mesh = field.mesh();
  const PersistenceHierarchy& hierarchy = segmenter.hierarchy();
  const MorseSmaleComplex& complex = hierarchy.complex();
  const Segments s = segmenter.segments(level);
  INFO("level " << level << " of " << hierarchy.levels());
  REQUIRE(s.kind == segmenter.kind());
  REQUIRE(s.level == level);
  REQUIRE(s.count() == segmenter.count(level));
  REQUIRE(s.triangle.size() == mesh.triangle_count());
  REQUIRE(s.vertex.size() == mesh.vertex_count());

  const DiscreteGradient gradient = hierarchy.gradient(level);
  const std::vector<Index> labels = traced_labels(field, gradient, s.kind);
  const bool across_edges = s.kind == SegmentKind::descending;
  REQUIRE(same_partition(s.triangle, pieces(mesh, labels, across_edges)));
  REQUIRE(same_partition(s.triangle, pieces(mesh, s.triangle, across_edges)));  // connected

  // Named and numbered as they should be.
  const mscomplex::Segmentation traced = segment(field, gradient);
  std::vector<Index> first(s.count(), kNone);
  for (Index t = mesh.triangle_count(); t-- > 0;) first[s.triangle[t]] = t;
  std::array<Index, 3> before = {};
  for (Index i = 0; i < s.count(); ++i) {
    const mscomplex::Segment& segment = s.segments[i];
    REQUIRE((segment.minimum == kNone) == (s.kind == SegmentKind::descending));
    REQUIRE((segment.top == kNone) == (s.kind == SegmentKind::ascending));
    if (segment.minimum != kNone) {
      REQUIRE(hierarchy.is_alive(segment.minimum, level));
      REQUIRE(complex.node(segment.minimum).cell == gradient.minima()[traced.ascending.triangle[first[i]]]);
    }
    if (segment.top != kNone) {
      REQUIRE(hierarchy.is_alive(segment.top, level));
      const auto maxima = gradient.maxima();
      const Index top = traced.descending.triangle[first[i]];
      if (top < maxima.size())
        REQUIRE(complex.node(segment.top).cell == maxima[top].cell);
      else
        REQUIRE(segment.top == complex.cap_node(top - static_cast<Index>(maxima.size())));
    }
    const std::array key = {segment.minimum, segment.top, first[i]};
    REQUIRE((i == 0 || before < key));
    before = key;
  }
  if (s.kind == SegmentKind::ascending) {
    REQUIRE(s.count() == hierarchy.minimum_count(level));
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      REQUIRE(complex.node(s.segments[s.vertex[v]].minimum).cell ==
              gradient.minima()[traced.ascending.vertex[v]]);
  }
  if (s.kind == SegmentKind::descending && mesh.is_closed())
    REQUIRE(s.count() == hierarchy.maximum_count(level));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    bool is_beside = false;
    mesh.for_each_outgoing(v, [&](Index h) { is_beside |= s.triangle[h / 3] == s.vertex[v]; });
    REQUIRE(is_beside);
  }
  check_measures(mesh, s);
  check_saddles(hierarchy, s);
}

void check_segments(const ScalarField& field, unsigned seed) {
  const PersistenceHierarchy hierarchy(field);
  const Index last = hierarchy.levels();
  std::mt19937 random(seed);
  std::vector<Index> levels = {0, static_cast<Index>(random() % (last + 1)), last};
  for (const SegmentKind kind : mscomplex::kSegmentKinds) {
    INFO(to_string(kind));
    const Segmenter segmenter(field, hierarchy, kind);
    for (const Index level : levels) check_level(field, segmenter, level);
    // Merging only makes segments coarser.
    Segments before = segmenter.segments(0);
    for (int i = 1; i <= 4; ++i) {
      Segments after = segmenter.segments(static_cast<Index>(std::uint64_t{last} * i / 4));
      REQUIRE(after.count() <= before.count());
      std::vector<Index> into(before.count(), kNone);
      for (Index t = 0; t < after.triangle.size(); ++t) {
        Index& to = into[before.triangle[t]];
        REQUIRE((to == kNone || to == after.triangle[t]));
        to = after.triangle[t];
      }
      before = std::move(after);
    }
    const Index most = segmenter.count(0);
    for (const Index wanted : {most, most / 2 + 1, Index{1}}) {
      const Index level = segmenter.level_with(wanted);
      if (segmenter.count(last) <= wanted) REQUIRE(segmenter.count(level) <= wanted);
      if (level > 0) REQUIRE(segmenter.count(level - 1) > wanted);
    }
  }
}

}  // namespace

// A strip of squares, each cut along its diagonal, with two valleys and a pass at 2 between them:
//   5---6---7---8---9
//   | / | / | / | / |
//   0---1---2---3---4
TEST_CASE("kinds of segments have names") {
  std::vector<std::string> names;
  for (const SegmentKind kind : mscomplex::kSegmentKinds) names.push_back(to_string(kind));
  CHECK(names == std::vector<std::string>{"descending", "ascending", "morse-smale"});
}

TEST_CASE("segments of a drawn strip have the expected sizes and borders") {
  const TriangleMesh mesh = grid(5, 2).mesh();
  const ScalarField field(mesh, {5, 1, 3, 0, 4, 8, 6, 9, 2, 7});
  const PersistenceHierarchy hierarchy(field);
  const MorseSmaleComplex& complex = hierarchy.complex();
  REQUIRE(complex.minimum_count() == 2);
  REQUIRE(complex.maximum_count() == 0);  // none inside: all flows out into the cap

  const Segmenter segmenter(field, hierarchy, SegmentKind::ascending);
  const Segments s = segmenter.segments(0);
  REQUIRE(s.count() == 2);
  CHECK(complex.node(s.segments[0].minimum).vertex == 1);
  CHECK(complex.node(s.segments[1].minimum).vertex == 3);
  CHECK(s.vertex == std::vector<Index>{0, 0, 1, 1, 1, 0, 0, 0, 1, 1});  // 7 descends along the diagonal to 1
  CHECK(s.triangle == std::vector<Index>{0, 0, 0, 0, 1, 1, 1, 1});
  for (const Index i : {0u, 1u}) {
    CHECK(s.segments[i].top == kNone);
    CHECK(s.segments[i].triangles == 4);
    CHECK(s.segments[i].vertices == 5);
    CHECK(s.segments[i].area == 2);
    CHECK(s.segments[i].boundary_length == 6);
    CHECK(s.segments[i].mesh_boundary_length == 5);
    REQUIRE(s.neighbours(i).size() == 1);
    CHECK(s.neighbours(i)[0].segment == 1 - i);
    CHECK(s.neighbours(i)[0].edges == 1);
    CHECK(s.neighbours(i)[0].length == 1);
    CHECK(std::vector(s.saddles(i).begin(), s.saddles(i).end()) == std::vector<Index>{2});
  }
  CHECK(segmenter.segments(1).count() == 1);
  CHECK(segmenter.segments(1).neighbours(0).empty());
  CHECK(complex.node(segmenter.segments(1).segments[0].minimum).vertex == 3);
  check_segments(field, 1);
}

TEST_CASE("segments around a monkey saddle have areas by hand") {
  const TriangleMesh mesh = bipyramid(6).mesh();
  const ScalarField field(mesh, {0, -9, 1, -1, 2, -2, 3, -3});
  const PersistenceHierarchy hierarchy(field);
  const Segmenter segmenter(field, hierarchy, SegmentKind::descending);
  const Segments s = segmenter.segments(0);
  REQUIRE(s.count() == 3);
  for (Index i = 0; i < 3; ++i) {
    CHECK(s.segments[i].triangles == 4);
    CHECK(std::vector(s.saddles(i).begin(), s.saddles(i).end()) == std::vector<Index>{0});
    CHECK(s.neighbours(i).size() == 2);
  }
  CHECK(segmenter.count(1) == 2);
  CHECK(segmenter.count(2) == 1);
  CHECK(segmenter.level_with(2) == 1);
  CHECK(segmenter.level_with(100) == 0);
  CHECK(hierarchy.complex().node(segmenter.segments(2).segments[0].top).vertex == 6);
}

TEST_CASE("segments are those of the level's gradient, connected, measured and joined to their saddles") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 81)) {
      INFO(entry.name << " | " << f.name);
      check_segments(f.field, 81);
    }
}

TEST_CASE("segments of random surfaces") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const TriangleMesh mesh = random_surface(seed);
    INFO("seed " << seed);
    check_segments(ScalarField(mesh, random_values(mesh.vertex_count(), seed)), seed);
    check_segments(ScalarField(mesh, tied_values(mesh.vertex_count(), 3, seed)), seed);
  }
}

TEST_CASE("segments of real surfaces, merged and not") {
  for (const char* file : {"bunny00.off", "lion-head.off", "refined_elephant.off"}) {
    INFO(file);
    const TriangleMesh mesh = read_plain_off(sample(file));
    const ScalarField field(mesh, plain_mean_curvature(mesh));
    const PersistenceHierarchy hierarchy(field);
    for (const SegmentKind kind : mscomplex::kSegmentKinds) {
      INFO(to_string(kind));
      const Segmenter segmenter(field, hierarchy, kind);
      const Index level = segmenter.level_with(30);
      CHECK(segmenter.count(level) <= 30);
      CHECK(segmenter.count(level - 1) > 30);
      check_level(field, segmenter, 0);
      check_level(field, segmenter, level);
    }
  }
}

TEST_CASE("merged segments at vertices of degree ten thousand") {
  for (const TriangleMesh& mesh : {wheel(10000).mesh(), bipyramid(10000).mesh()})
    for (const NamedField& f : field_zoo(mesh, 83)) {
      INFO(mesh.vertex_count() << " vertices | " << f.name);
      const PersistenceHierarchy hierarchy(f.field);
      for (const SegmentKind kind : mscomplex::kSegmentKinds) {
        const Segmenter segmenter(f.field, hierarchy, kind);
        const Segments s = segmenter.segments(hierarchy.levels() / 2);
        check_measures(mesh, s);
        REQUIRE(same_partition(s.triangle, pieces(mesh, s.triangle, kind == SegmentKind::descending)));
      }
    }
}

TEST_CASE("merged segments are the same for every number of threads") {
  const TriangleMesh mesh = punctured_sphere(5, 5).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 84));
  for (const SegmentKind kind : mscomplex::kSegmentKinds) {
    const auto with = [&](int threads) {
      core::ThreadLimit limit(threads);
      const PersistenceHierarchy hierarchy(field);
      return Segmenter(field, hierarchy, kind).segments(hierarchy.levels() / 2);
    };
    const Segments one = with(1);
    for (const int threads : {2, 7}) {
      const Segments many = with(threads);
      CHECK(one.triangle == many.triangle);
      CHECK(one.vertex == many.vertex);
      CHECK(one.saddle_offset == many.saddle_offset);
      CHECK(one.saddle == many.saddle);
      REQUIRE(one.count() == many.count());
      for (Index i = 0; i < one.count(); ++i) {
        REQUIRE(one.segments[i].area == many.segments[i].area);
        REQUIRE(one.segments[i].boundary_length == many.segments[i].boundary_length);
        REQUIRE(std::equal(one.neighbours(i).begin(), one.neighbours(i).end(), many.neighbours(i).begin(),
                           many.neighbours(i).end(), [](const auto& a, const auto& b) {
                             return a.segment == b.segment && a.edges == b.edges && a.length == b.length;
                           }));
      }
    }
  }
}

TEST_CASE("segments refuse another mesh and levels that do not exist") {
  const std::vector<double> values = {9, -9, 1, 2, 3, 4};
  const ScalarField field(octahedron().mesh(), values);
  const PersistenceHierarchy hierarchy(field);
  CHECK_THROWS_AS(Segmenter(ScalarField(octahedron().mesh(), values), hierarchy, SegmentKind::ascending),
                  core::InvalidArgument);
  const Segmenter segmenter(field, hierarchy, SegmentKind::ascending);
  CHECK_THROWS_AS(segmenter.segments(hierarchy.levels() + 1), core::InvalidArgument);
}
