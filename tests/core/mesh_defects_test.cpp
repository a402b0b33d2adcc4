// The rules of a mesh: each way to break one is found, named and counted.

#include "morsel/core/mesh/mesh_defects.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "morsel/core/mesh/mesh.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::Defect;
using core::DefectKind;
using core::kNone;

namespace {

/// The defects of a soup that the mesh refuses, by kind; empty if it is a mesh.
std::map<DefectKind, Defect> defects_of(const Soup& soup) {
  std::map<DefectKind, Defect> result;
  for (const Defect& d : core::find_defects(soup.positions, soup.triangles)) result[d.kind] = d;
  try {
    soup.mesh().validate();
    CHECK(result.empty());
  } catch (const core::MeshError& error) {
    CHECK(error.defects().size() == result.size());
    for (const Defect& d : error.defects()) CHECK(result[d.kind].first == d.first);
  }
  return result;
}

void check_only(const Soup& soup, DefectKind kind, std::size_t count, const std::vector<Index>& first) {
  const auto defects = defects_of(soup);
  REQUIRE(defects.size() == 1);
  REQUIRE(defects.begin()->first == kind);
  CHECK(defects.begin()->second.count == count);
  CHECK(defects.begin()->second.first == first);
}

}  // namespace

TEST_CASE("sound meshes have no defects") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    CHECK(core::find_defects(entry.mesh.positions(), entry.mesh.triangles()).empty());
  }
}

TEST_CASE("a mesh without triangles is refused") {
  check_only({}, DefectKind::empty, 1, {});
  CHECK_THROWS_WITH(Soup{}.mesh(), "the mesh cannot be used: it has no triangle");
}

TEST_CASE("non-finite positions are found") {
  Soup soup = octahedron();
  soup.positions[3].y() = NAN;
  soup.positions[5].z() = -INFINITY;
  check_only(soup, DefectKind::non_finite_position, 2, {3, 5});
}

TEST_CASE("faces that name missing vertices are found and left out of other checks") {
  Soup soup = tetrahedron();
  soup.triangles.push_back({0, 0, 4});
  soup.triangles.push_back({1, kNone, 2});
  check_only(soup, DefectKind::index_out_of_range, 2, {4, 5});
}

TEST_CASE("degenerate faces are found") {
  Soup soup = tetrahedron();
  soup.triangles.push_back({3, 1, 3});
  check_only(soup, DefectKind::degenerate_face, 1, {4});
}

TEST_CASE("a second face on the same vertices is found in either orientation") {
  Soup soup = tetrahedron();
  soup.triangles.push_back({1, 0, 2});
  soup.triangles.push_back({2, 0, 1});
  check_only(soup, DefectKind::duplicate_face, 2, {4, 5});
  // A pillow is closed, manifold and oriented, yet its two faces have the same vertices.
  check_only({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}}, DefectKind::duplicate_face, 1, {1});
}

TEST_CASE("unused vertices are found and only the first few are named") {
  Soup soup = tetrahedron();
  for (int i = 0; i < 7; ++i) soup.positions.emplace_back(i, 5, 5);
  check_only(soup, DefectKind::unreferenced_vertex, 7, {4, 5, 6, 7, 8});
  CHECK_THROWS_WITH(soup.mesh(), Catch::Contains("7 vertices that no face uses (the first: 4, 5, 6, 7, 8)") &&
                                     Catch::Contains("--repair"));
}

TEST_CASE("an edge of three faces is found") {
  const Soup soup{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                  {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
  auto defects = defects_of(soup);
  CHECK(defects[DefectKind::non_manifold_edge].count == 1);
  CHECK(defects[DefectKind::non_manifold_edge].first == std::vector<Index>{0, 1});
  CHECK(defects[DefectKind::non_manifold_vertex].first == std::vector<Index>{0, 1});
  CHECK(defects.size() == 2);
}

TEST_CASE("a face that runs against its neighbours is found") {
  Soup soup = tetrahedron();
  std::swap(soup.triangles[2][0], soup.triangles[2][1]);
  check_only(soup, DefectKind::inconsistent_orientation, 3, {1, 2, 1, 3, 2, 3});
}

TEST_CASE("a Moebius band is found not to be orientable") {
  const Soup soup = moebius(7);
  auto defects = defects_of(soup);
  CHECK(defects[DefectKind::non_orientable].count == soup.triangles.size());
  CHECK(defects.size() == 1);  // its edges of opposite faces do not count
  CHECK_THROWS_WITH(soup.mesh(), Catch::Contains("cannot be oriented") && !Catch::Contains("--repair"));
  // Only the faces of that component count.
  auto both = defects_of(together(sphere(1), soup));
  CHECK(both[DefectKind::non_orientable].count == soup.triangles.size());
  CHECK(both[DefectKind::non_orientable].first.front() == sphere(1).triangles.size());
}

TEST_CASE("vertices where fans meet are found") {
  // Two triangles, two tetrahedra, and a grid with two opposite corners of a cell cut out, meeting in a
  // vertex.
  const Soup bow_tie{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  check_only(bow_tie, DefectKind::non_manifold_vertex, 1, {0});
  Soup two = together(tetrahedron(), tetrahedron());
  for (auto& t : two.triangles)
    for (Index& v : t) v = v == 4 ? 3 : v > 4 ? v - 1 : v;
  two.positions.pop_back();
  check_only(two, DefectKind::non_manifold_vertex, 1, {3});
  Soup disc = grid(5, 5);
  std::erase_if(disc.triangles, [](const core::Triangle& t) {
    const Index x = t[0] % 5, y = t[0] / 5;  // the lower left corner of the cell
    return (x == 1 && y == 1) || (x == 2 && y == 2);
  });
  check_only(disc, DefectKind::non_manifold_vertex, 1, {12});
}

TEST_CASE("a mesh with several defects has them all named in one sentence") {
  Soup soup = together(tetrahedron(), moebius(5));
  soup.positions.emplace_back(9, 9, 9);
  soup.triangles.push_back({1, 1, 2});
  const auto thrown = [&] { return soup.mesh(); };
  CHECK_THROWS_WITH(thrown(),
                    Catch::StartsWith("the mesh cannot be used: it has 1 degenerate face (14), 1 vertex "
                                      "that no face uses (14) and 10 faces of components "));
  CHECK_THROWS_WITH(thrown(), Catch::EndsWith("repair cannot fix components that cannot be oriented"));
}

TEST_CASE("the sentence of a refused mesh can have another subject and depends on repair") {
  const std::vector<Defect> defects = {{DefectKind::degenerate_face, 1, {4}},
                                       {DefectKind::non_manifold_edge, 2, {1, 2, 1, 3}}};
  CHECK(std::string(core::MeshError(defects).about("a.off").what()) ==
        "a.off cannot be used: it has 1 degenerate face (4) and 2 non-manifold edges (1-2, 1-3); repair "
        "(--repair) "
        "would fix this by removing degenerate faces and repeated corners and splitting non-manifold edges");
  CHECK(std::string(core::MeshError(defects, true).what()) ==
        "the mesh cannot be used: after repair it still has 1 degenerate face (4) and 2 non-manifold edges "
        "(1-2, "
        "1-3)");
}

TEST_CASE("triangles that are parts of faces are counted by face") {
  const Soup soup = moebius(5);
  std::vector<Index> faces;
  for (Index t = 0; t < soup.triangles.size(); ++t) faces.push_back(10 + t / 2);
  const auto defects = core::find_defects(soup.positions, soup.triangles, faces);
  REQUIRE(defects.back().kind == DefectKind::non_orientable);
  CHECK(defects.back().count == 5);
  CHECK(defects.back().first == std::vector<Index>{10, 11, 12, 13, 14});
}
