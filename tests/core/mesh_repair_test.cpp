// Each repair on its own with its exact result, and all of them on randomly damaged meshes.

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::BuiltMesh;
using core::kNone;
using core::PolygonSoup;
using core::Triangle;

namespace {

PolygonSoup polygons(const Soup& soup) {
  PolygonSoup result;
  result.positions = soup.positions;
  for (const Triangle& t : soup.triangles) result.add_polygon(t);
  return result;
}

BuiltMesh repaired(const Soup& soup) {
  CHECK_THROWS_AS(core::build_mesh(polygons(soup)), core::MeshError);
  BuiltMesh built = core::build_mesh(polygons(soup), {.repair = true});
  built.mesh.validate();
  return built;
}

std::string listed(const BuiltMesh& built) {
  std::string text;
  for (const core::Repair& r : built.repairs)
    text += (text.empty() ? "" : ", ") + r.action + " " + std::to_string(r.count);
  return text;
}

std::vector<Triangle> triangles(const BuiltMesh& built) {
  return {built.mesh.triangles().begin(), built.mesh.triangles().end()};
}

double volume(const core::TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles()) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = mesh.position(t[i]);
    sum += corners.determinant() / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("nothing is repaired in a sound mesh") {
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    PolygonSoup soup;
    soup.positions.assign(entry.mesh.positions().begin(), entry.mesh.positions().end());
    for (const Triangle& t : entry.mesh.triangles()) soup.add_polygon(t);
    for (const bool repair : {false, true}) {
      const BuiltMesh built = core::build_mesh(soup, {.repair = repair});
      CHECK(std::equal(built.mesh.triangles().begin(), built.mesh.triangles().end(),
                       entry.mesh.triangles().begin(), entry.mesh.triangles().end()));
      CHECK(built.repairs.empty());
      CHECK(built.numbering.to_input.empty());
      CHECK(built.numbering.from_input.empty());
      CHECK(built.numbering.input_count == entry.mesh.vertex_count());
    }
  }
}

TEST_CASE("unused vertices are removed and the numbering maps the others") {
  Soup soup = square_pair();
  soup.positions.insert(soup.positions.begin() + 1, Point(7, 7, 7));
  soup.positions.emplace_back(8, 8, 8);
  for (auto& t : soup.triangles)
    for (Index& v : t) v += v >= 1;
  const BuiltMesh built = repaired(soup);
  CHECK(listed(built) == "removed_unreferenced_vertices 2");
  CHECK(triangles(built) == square_pair().triangles);
  CHECK(built.mesh.position(1) == Point(1, 0, 0));
  CHECK(built.numbering.input_count == 6);
  CHECK(built.numbering.to_input == std::vector<Index>{0, 2, 3, 4});
  CHECK(built.numbering.from_input == std::vector<Index>{0, kNone, 1, 2, 3, kNone});
  CHECK(built.numbering.input_vertex(1) == 2);
  CHECK(built.numbering.mesh_vertex(1) == kNone);
}

TEST_CASE("degenerate and duplicate faces are removed with what only they used") {
  Soup soup = tetrahedron();
  soup.positions.emplace_back(5, 5, 5);
  soup.triangles.insert(soup.triangles.begin() + 1, {4, 4, 1});
  soup.triangles.push_back({0, 1, 2});
  soup.triangles.push_back({2, 1, 0});
  const BuiltMesh built = repaired(soup);
  CHECK(listed(built) ==
        "removed_degenerate_faces 1, removed_duplicate_faces 2, removed_unreferenced_vertices 1");
  CHECK(triangles(built) == tetrahedron().triangles);
}

TEST_CASE("of a pillow the first face is kept") {
  const BuiltMesh built = repaired({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}});
  CHECK(listed(built) == "removed_duplicate_faces 1");
  CHECK(triangles(built) == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("a vertex of two fans becomes two vertices at one place") {
  const BuiltMesh built =
      repaired({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{1, 2, 0}, {0, 3, 4}}});
  CHECK(listed(built) == "split_non_manifold_vertices 1");
  CHECK(triangles(built) == std::vector<Triangle>{{1, 2, 0}, {5, 3, 4}});
  CHECK(built.mesh.position(5) == built.mesh.position(0));
  CHECK(built.numbering.to_input == std::vector<Index>{0, 1, 2, 3, 4, 0});
  CHECK(built.numbering.from_input == std::vector<Index>{0, 1, 2, 3, 4});
}

TEST_CASE("faces at an edge of three are separated") {
  const BuiltMesh built =
      repaired({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}});
  CHECK(listed(built) == "split_non_manifold_edges 1, split_non_manifold_vertices 2");
  CHECK(triangles(built) == std::vector<Triangle>{{0, 1, 2}, {5, 6, 3}, {7, 8, 4}});
  CHECK(built.numbering.to_input == std::vector<Index>{0, 1, 2, 3, 4, 0, 1, 1, 0});
}

TEST_CASE("closed surfaces that share an edge come apart closed") {
  // Sheets that are joined around both ends of the edge stay joined across it.
  Soup soup = together(octahedron(), octahedron());
  for (auto& t : soup.triangles)
    for (Index& v : t) v = v == 6 ? 0 : v == 8 ? 2 : v;  // the second's edge 0-2 is the first's
  const BuiltMesh built = repaired(soup);
  CHECK(listed(built) ==
        "split_non_manifold_edges 1, split_non_manifold_vertices 2, removed_unreferenced_vertices 2");
  CHECK(built.mesh.component_count() == 2);
  CHECK(built.mesh.is_closed());
  CHECK(built.mesh.euler_characteristic() == 4);
}

TEST_CASE("a closed component is oriented outward") {
  for (const bool inward : {false, true}) {
    Soup soup = sphere(2);
    std::mt19937 random(5);
    std::size_t turned = 0;
    for (auto& t : soup.triangles)
      if (inward ? random() % 10 > 0 : random() % 10 == 0) {
        std::swap(t[0], t[1]);
        ++turned;
      }
    const BuiltMesh built = repaired(soup);
    CHECK(listed(built) == "reoriented_faces " + std::to_string(turned));
    CHECK(volume(built.mesh) > 0);
    CHECK(built.mesh.genus() == 0);
  }
}

TEST_CASE("a consistent component keeps its orientation") {
  Soup inward = tetrahedron();
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  Soup mixed = octahedron();
  std::swap(mixed.triangles[0][0], mixed.triangles[0][1]);
  const BuiltMesh built = repaired(together(inward, mixed));
  CHECK(listed(built) == "reoriented_faces 1");
  CHECK(std::equal(inward.triangles.begin(), inward.triangles.end(), built.mesh.triangles().begin()));
}

TEST_CASE("an open component is oriented as most of its faces are and else as the first is") {
  Soup disc = grid(4, 4);
  for (const std::size_t t : {0u, 5u, 6u}) std::swap(disc.triangles[t][0], disc.triangles[t][1]);
  const BuiltMesh most = repaired(disc);
  CHECK(listed(most) == "reoriented_faces 3");
  CHECK(volume(most.mesh) == 0);
  Soup pair = square_pair();
  std::swap(pair.triangles[1][0], pair.triangles[1][1]);
  CHECK(triangles(repaired(pair)).front() == square_pair().triangles.front());
}

TEST_CASE("what cannot be repaired is refused with what remains") {
  const auto repair = [](const Soup& soup) { return core::build_mesh(polygons(soup), {.repair = true}); };
  Soup band = moebius(6);
  band.positions.insert(band.positions.begin(), Point(9, 9, 9));
  for (auto& t : band.triangles)
    for (Index& v : t) ++v;
  CHECK_THROWS_WITH(repair(band),
                    Catch::Contains("after repair it still has 12 faces of components that cannot be"));
  band.positions[3].x() = NAN;  // mesh vertex 2 by then
  CHECK_THROWS_WITH(repair(band), Catch::Contains("1 vertex with a non-finite coordinate (3)"));

  Soup missing = tetrahedron();
  missing.triangles.push_back({0, 1, 4});
  CHECK_THROWS_WITH(repair(missing), Catch::Contains("1 face that names a vertex that does not exist (4)"));
  CHECK_THROWS_WITH(repair({{{0, 0, 0}}, {{0, 0, 0}}}), Catch::Contains("after repair it has no triangle"));
}

TEST_CASE("a non-finite position is accepted if its vertex is removed") {
  Soup soup = tetrahedron();
  soup.positions.emplace_back(NAN, 0, 0);
  CHECK(repaired(soup).mesh.vertex_count() == 4);
}

TEST_CASE("a soup whose tables contradict each other is refused") {
  PolygonSoup soup = polygons(tetrahedron());
  soup.offsets[2] = 99;
  CHECK_THROWS_AS(core::build_mesh(soup), core::InvalidArgument);
  soup.offsets = {};
  CHECK_THROWS_AS(core::build_mesh(soup), core::InvalidArgument);
}

TEST_CASE("repair of randomly damaged meshes gives a valid mesh or says what remains") {
  std::mt19937 random(99);
  const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
  int meshes = 0;
  for (int round = 0; round < 40; ++round)
    for (const NamedMesh& entry : mesh_zoo()) {
      Soup soup;
      soup.positions.assign(entry.mesh.positions().begin(), entry.mesh.positions().end());
      soup.triangles.assign(entry.mesh.triangles().begin(), entry.mesh.triangles().end());
      if (soup.triangles.size() > 400) continue;
      for (unsigned damage = 1 + random() % 12; damage > 0; --damage) {
        Triangle& t = soup.triangles[below(soup.triangles.size())];
        switch (random() % 7) {
          case 0:
            std::swap(t[0], t[1]);
            break;
          case 1:
            t[below(3)] = below(soup.positions.size());
            break;
          case 2:
            soup.triangles.push_back(Triangle(t));
            break;
          case 3:
            t = soup.triangles.back(), soup.triangles.pop_back();
            break;
          case 4:
            soup.positions.emplace_back(1, 2, 3);
            break;
          case 5: {  // glue one vertex to another
            const Index from = below(soup.positions.size()), to = below(soup.positions.size());
            for (auto& u : soup.triangles)
              for (Index& v : u) v = v == from ? to : v;
            break;
          }
          default: {
            const auto n = soup.positions.size();
            soup.triangles.push_back({below(n), below(n), below(n)});
          }
        }
        if (soup.triangles.empty()) break;
      }
      INFO(entry.name << ", round " << round);
      std::set<core::DefectKind> lasting;  // as the defects of the damaged mesh have it
      try {
        core::build_mesh(polygons(soup));
      } catch (const core::MeshError& error) {
        for (const core::Defect& d : error.defects())
          if (core::repair_of(d.kind).empty()) lasting.insert(d.kind);
      }
      try {
        const BuiltMesh built = core::build_mesh(polygons(soup), {.repair = true});
        built.mesh.validate();
        REQUIRE(lasting.empty());
        ++meshes;
        // Positions follow their vertices.
        for (Index v = 0; v < built.mesh.vertex_count(); ++v)
          REQUIRE(built.mesh.position(v) == soup.positions[built.numbering.input_vertex(v)]);
        // What is repaired once needs no more repair.
        PolygonSoup again;
        again.positions.assign(built.mesh.positions().begin(), built.mesh.positions().end());
        for (const Triangle& t : built.mesh.triangles()) again.add_polygon(t);
        REQUIRE_NOTHROW(core::build_mesh(again));
      } catch (const core::MeshError& error) {
        CHECK_FALSE(lasting.empty());
        for (const core::Defect& d : error.defects())
          REQUIRE((d.kind == core::DefectKind::non_orientable || d.kind == core::DefectKind::empty));
      }
    }
  CHECK(meshes > 100);
}
