// Welding: which vertices become one, against a search of all pairs; what becomes of polygons, numbers and
// values; and the recognition of vertices that should have been joined.

#include "morsel/core/mesh/welding.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/face_values.h"
#include "morsel/core/io/mesh_io.h"
#include "support/meshes.h"

using namespace morsel;
using namespace morsel::test;
using core::BuiltMesh;
using core::kNone;
using core::Length;
using core::Point;
using core::PolygonSoup;

namespace {

/// The rule as it stands, by all pairs.
std::vector<Index> slowly_joined(const std::vector<Point>& positions, double length) {
  std::vector<Index> joined(positions.size());
  for (Index v = 0; v < joined.size(); ++v) {
    joined[v] = v;
    for (Index u = 0; u < v && joined[v] == v; ++u) {
      const Point d = positions[v] - positions[u];
      const bool is_near =
          length == 0 ? positions[v] == positions[u] : std::hypot(d.x(), d.y(), d.z()) <= length;
      if (joined[u] == u && positions[u].allFinite() && positions[v].allFinite() && is_near) joined[v] = u;
    }
  }
  return joined;
}

/// Each triangle with vertices of its own, as programs write it that know no shared vertices.
PolygonSoup exploded(const Soup& soup) {
  PolygonSoup result;
  for (const core::Triangle& t : soup.triangles) {
    std::vector<Index> corners;
    for (const Index v : t) {
      corners.push_back(static_cast<Index>(result.positions.size()));
      result.positions.push_back(soup.positions[v]);
    }
    result.add_polygon(corners);
  }
  return result;
}

PolygonSoup polygons_of(std::vector<Point> positions, const std::vector<std::vector<Index>>& polygons) {
  PolygonSoup result;
  result.positions = std::move(positions);
  for (const auto& polygon : polygons) result.add_polygon(polygon);
  return result;
}

std::string repairs_of(const BuiltMesh& built) {
  std::string text;
  for (const core::Repair& r : built.repairs)
    text += (text.empty() ? "" : ", ") + r.action + " " + std::to_string(r.count);
  return text;
}

const core::BuildOptions kExactly{.weld = Length::absolute(0)};

}  // namespace

TEST_CASE("vertices at one position become the first of them") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Point> positions = {{0, 0, 1}, {1, 0, 0},   {-0.0, 0, 1},
                                        {1, 0, 0}, {nan, 0, 0}, {nan, 0, 0}};
  CHECK(core::coincident_vertices(positions) == std::vector<Index>{0, 1, 0, 1, 4, 5});
  CHECK(core::coincident_vertices({}).empty());
}

TEST_CASE("within a length each vertex joins the first representative") {
  const std::vector<Point> chain = {{0, 0, 0}, {0.9, 0, 0}, {1.8, 0, 0}, {1, 0, 0}, {2.7, 0, 0}};
  CHECK(core::coincident_vertices(chain, 1) ==
        std::vector<Index>{0, 0, 2, 0, 2});  // a distance of 1 is within
  CHECK_THROWS_AS(core::coincident_vertices(chain, -1), core::InvalidArgument);
  CHECK_THROWS_AS(core::coincident_vertices(chain, NAN), core::InvalidArgument);
  // Larger than everything: all are one.
  CHECK(core::coincident_vertices(chain, 1e308) == std::vector<Index>(5, 0));
  CHECK(core::coincident_vertices(std::vector<Point>(3, Point::Zero()), 1e-300) == std::vector<Index>(3, 0));
}

TEST_CASE("joined vertices are those of a search of all pairs") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double scale : {1.0, 1e-200, 1e200, 1e-310, 1e280})
    for (const double offset : {0.0, 1.0, 1e9, 1e17})
      for (const double length : {0.0, 1e-9, 0.05, 0.3, 5.0}) {
        std::vector<Point> positions;
        for (int i = 0; i < 150; ++i) {
          Point p(normal(random), normal(random), normal(random));
          if (i % 3 == 1) p = positions[random() % positions.size()] / scale - Point(offset, offset, -offset);
          if (i % 6 == 1) p += 0.04 * Point(normal(random), normal(random), normal(random));
          if (i % 5 == 0) p = (p * 4).array().round() / 4;  // ties
          positions.emplace_back((p + Point(offset, offset, -offset)) * scale);
        }
        positions[5].x() = INFINITY;
        INFO("scale " << scale << ", offset " << offset << ", length " << length);
        CHECK(core::coincident_vertices(positions, length * scale) ==
              slowly_joined(positions, length * scale));
      }
}

TEST_CASE("a sphere of loose triangles is welded to the sphere") {
  const Soup whole = sphere(2);
  const PolygonSoup loose = exploded(whole);
  REQUIRE(loose.positions.size() == 960);
  const BuiltMesh before = core::build_mesh(loose);
  CHECK(before.mesh.component_count() == 320);
  CHECK(
      core::unwelded_warning(before.mesh, before.numbering) ==
      "798 of 960 vertices coincide with others, so that faces are not joined there; welding (--weld) joins "
      "them");
  for (const Length& length : {Length::absolute(0), Length::absolute(1e-6), Length::epsilons(0.1),
                               Length::edges(0.01), Length::percent(0.1), Length::root_areas(0.001)}) {
    const BuiltMesh built = core::build_mesh(loose, {.weld = length});
    built.mesh.validate();
    CHECK(built.mesh.vertex_count() == 162);
    CHECK(built.mesh.euler_characteristic() == 2);
    CHECK(repairs_of(built) == "welded_vertices 798");
    CHECK(built.warnings.empty());
    CHECK(core::count_unwelded(built.mesh, built.numbering) == 0);
    CHECK(built.numbering.input_count == 960);
    for (Index v = 0; v < 960; ++v) {
      const Index at = built.numbering.mesh_vertex(v);
      REQUIRE(built.mesh.position(at) == loose.positions[v]);
      REQUIRE(built.numbering.input_vertex(at) <= v);
    }
  }
  CHECK_THROWS_AS(core::build_mesh(loose, {.weld = Length::absolute(-1)}), core::InvalidArgument);
  // A mesh whose vertices are shared stays as it is.
  const PolygonSoup shared = whole.polygons();
  const BuiltMesh same = core::build_mesh(shared, kExactly);
  CHECK(same.repairs.empty());
  CHECK(same.numbering.to_input.empty());
}

TEST_CASE("coordinates that are too large for cells are refused") {
  const std::vector<Point> far = {{1e301, 0, 0}, {0, 0, 0}};
  CHECK(core::coincident_vertices(far) == std::vector<Index>{0, 1});
  CHECK_THROWS_WITH(core::coincident_vertices(far, 1), Catch::Contains("as large as 1e+301"));
}

TEST_CASE("lengths on polygons are those on the mesh") {
  const Soup soup = sphere(2);
  const PolygonSoup polygons = soup.polygons();
  for (const Length& length : {Length::absolute(0.5), Length::epsilons(2), Length::edges(2),
                               Length::percent(3), Length::root_areas(0.5)})
    CHECK(core::length_on(length, polygons) == Approx(length.on(soup.mesh())).epsilon(1e-12));
}

TEST_CASE("lengths on polygons leave out corners that are no vertices") {
  const std::vector<Point> positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  const PolygonSoup good = polygons_of(positions, {{0, 2, 1}});
  PolygonSoup damaged = good;
  damaged.add_polygon(std::vector<Index>{1, 2, 400'000'000});
  damaged.add_polygon(std::vector<Index>{kNone, kNone, kNone});
  damaged.add_polygon(std::vector<Index>{0, 3, 2, 1});
  for (const Length& length :
       {Length::absolute(0.5), Length::epsilons(2), Length::percent(3), Length::root_areas(0.5)}) {
    CHECK(core::length_on(length, damaged) == core::length_on(length, good));
    CHECK_THROWS_AS(core::build_mesh(damaged, {.weld = length}), core::BadInput);
  }
  // Of the sides of all polygons 3, 4, 5, 5, 5 and 3 have two vertices.
  CHECK(core::length_on(Length::edges(1), damaged) == Approx(25.0 / 6));
  CHECK_THROWS_AS(core::build_mesh(damaged, {.weld = Length::edges(1)}), core::BadInput);
}

TEST_CASE("the search for vertices that coincide can be cancelled") {
  // Two vertices a triangle on the boundary, more than what is done between two checks.
  std::vector<Point> positions;
  std::vector<core::Triangle> triangles;
  for (Index i = 0; i < 30'000; ++i) {
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    for (const Point& p : {Point(i, 0, 0), Point(i + 0.5, 0, 0), Point(i, 1, 0)}) positions.push_back(p);
  }
  const core::TriangleMesh mesh(std::move(positions), std::move(triangles));
  std::stop_source stop;
  const core::Progress progress({}, stop.get_token());
  CHECK(core::unwelded_warning(mesh, {}, progress).empty());
  stop.request_stop();
  CHECK_THROWS_AS(core::unwelded_warning(mesh, {}, progress), core::Cancelled);
}

TEST_CASE("faces that collapse are removed and counted") {
  // Two triangles at an edge, and a third and a quad that lie in it when 4 and 5 join 0 and 1.
  const PolygonSoup soup =
      polygons_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0, 0, 1e-9}, {1, 0, 1e-9}},
                  {{0, 1, 2}, {4, 3, 5}, {0, 4, 1}, {1, 4, 5, 0}});
  const BuiltMesh built = core::build_mesh(soup, {.weld = Length::absolute(1e-6)});
  built.mesh.validate();
  CHECK(built.mesh.triangle_count() == 2);
  CHECK(built.mesh.component_count() == 1);
  CHECK(repairs_of(built) == "welded_vertices 2, removed_collapsed_faces 2");
  REQUIRE(built.warnings.size() == 1);
  CHECK(built.warnings[0] == "2 faces were removed, of which joined vertices leave fewer than three corners");
  CHECK(built.numbering.from_input == std::vector<Index>{0, 1, 2, 3, 0, 1});
}

TEST_CASE("polygons lose repeated corners and sides that run back and forth") {
  const auto reduced = [](std::vector<Index> polygon, const std::vector<Index>& same) {
    std::vector<Point> positions;
    for (const Index v : same) positions.emplace_back(v, v * v, 1);
    const core::WeldedSoup welded = core::weld(polygons_of(positions, {polygon}), 0);
    std::vector<Index> result;
    for (const Index v : welded.soup.polygon(0)) result.push_back(welded.numbering.input_vertex(v));
    return result;
  };
  CHECK(reduced({0, 1, 2, 3}, {0, 1, 2, 2}) == std::vector<Index>{0, 1, 2});
  CHECK(reduced({0, 1, 2, 3}, {0, 1, 2, 0}) == std::vector<Index>{0, 1, 2});
  CHECK(reduced({0, 1, 2, 3}, {0, 1, 0, 3}).empty());
  CHECK(reduced({0, 1, 2, 3, 4}, {0, 1, 2, 1, 4}) == std::vector<Index>{0, 1, 4});
  CHECK(reduced({0, 1, 2, 3, 4}, {0, 1, 2, 3, 1}) == std::vector<Index>{1, 2, 3});
  CHECK(reduced({0, 1, 2, 3, 4}, {0, 1, 2, 0, 4}) == std::vector<Index>{0, 1, 2});
  // What the file repeats itself is left for the rules of a mesh.
  CHECK(reduced({0, 1, 1, 2}, {0, 1, 2, 2}) == std::vector<Index>{0, 1, 1, 2});
}

TEST_CASE("errors after welding have the numbers of the file") {
  PolygonSoup soup = exploded(tetrahedron());
  soup.positions.emplace_back(7, 7, 7);  // 12, used by no face
  CHECK_THROWS_WITH(core::build_mesh(soup, kExactly), Catch::Contains("1 vertex that no face uses (12)"));
  const BuiltMesh built = core::build_mesh(soup, {true, Length::absolute(0)});
  CHECK(repairs_of(built) == "welded_vertices 8, removed_unreferenced_vertices 1");
  CHECK(built.numbering.mesh_vertex(12) == kNone);
  CHECK(built.numbering.input_count == 13);
  for (Index v = 0; v < 12; ++v)
    CHECK(built.mesh.position(built.numbering.mesh_vertex(v)) == soup.positions[v]);
}

TEST_CASE("only vertices at coincident boundary edges are unwelded") {
  // Two triangles that meet in a vertex, by two vertices: welding would make a vertex of two fans.
  CHECK(core::count_unwelded(
            core::build_mesh(polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                                         {{0, 1, 2}, {3, 4, 5}}))
                .mesh) == 0);
  const BuiltMesh seam = core::build_mesh(polygons_of(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {4, 3, 5}}));
  CHECK(core::count_unwelded(seam.mesh) == 2);
  CHECK(core::count_unwelded(sphere(1).mesh()) == 0);
  // Copies that repair made are of one vertex.
  const BuiltMesh split =
      core::build_mesh(polygons_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                                   {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}),
                       {.repair = true});
  REQUIRE(split.mesh.vertex_count() > 5);
  CHECK(core::count_unwelded(split.mesh, split.numbering) == 0);
  CHECK(core::count_unwelded(split.mesh) > 0);
}

TEST_CASE("values of joined vertices that differ are told, and the first is taken") {
  core::LoadedSoup file;
  file.soup = exploded(tetrahedron());
  std::vector<double> same, different;
  for (const Point& p : file.soup.positions) same.push_back(p.x());
  different = same;
  different[11] += 0.5;
  different[10] = NAN;
  file.properties = {{"height", same}, {"noise", different}};
  const core::LoadedMesh loaded = core::make_mesh(file, "a.ply", kExactly);
  REQUIRE(loaded.source.warnings.size() == 1);
  CHECK_THAT(loaded.source.warnings[0], Catch::Contains("\"noise\" at 2 (by up to 0.5)"));
  CHECK(loaded.source.properties[1].values[11] == different[11]);  // as in the file
  CHECK(core::make_mesh(file, "a.ply", {}).source.warnings.size() == 1);
  CHECK_THROWS_AS(core::compare_joined(loaded.source.numbering, std::vector<double>(3)),
                  core::InvalidArgument);
}

TEST_CASE("values of faces become means at vertices by area") {
  core::LoadedSoup file;
  // A square of area 1 and a triangle of area 2 at the edge 1-2; vertex 5 is used by none.
  file.soup = polygons_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {9, 9, 9}},
                          {{0, 1, 2, 3}, {1, 4, 2}});
  file.properties = {{"quality", {0, 1, 2, 3, 4, 5}}};
  file.face_properties = {{"label", {3, 6}}, {"quality", {1, 4}}};
  file.warnings = {"a sentence"};
  const core::LoadedMesh loaded = core::make_mesh(file, "a.ply", {.repair = true});
  const auto& properties = loaded.source.properties;
  REQUIRE(properties.size() == 3);
  CHECK(properties[1].name == "label");
  CHECK(properties[2].name == "face:quality");
  CHECK(std::vector<double>(properties[1].values.begin(), properties[1].values.begin() + 5) ==
        std::vector<double>{3, 5, 5, 3, 6});
  CHECK(std::isnan(properties[1].values[5]));
  CHECK(properties[2].values[1] == 3);
  CHECK(loaded.source.warnings == std::vector<std::string>{"a sentence"});

  file.face_properties[0].values.pop_back();
  CHECK_THROWS_AS(core::make_mesh(file, "a.ply", {.repair = true}), core::InvalidArgument);

  // Those of loose triangles are means over all that are joined; faces without area count alike among
  // themselves.
  core::LoadedSoup loose;
  loose.soup = polygons_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, -3, 0}},
                           {{0, 1, 2}, {4, 3, 5}});
  loose.face_properties = {{"label", {1, 5}}};
  const core::LoadedMesh joined = core::make_mesh(loose, "b.ply", kExactly);
  CHECK(joined.source.properties[0].values == std::vector<double>{4, 4, 1, 4, 4, 5});
  loose.soup.positions[2] = {0.5, 0, 0};
  loose.soup.positions[5] = {0.25, 0, 0};
  const core::LoadedMesh flat = core::make_mesh(loose, "b.ply", kExactly);
  CHECK(flat.source.properties[0].values == std::vector<double>{3, 3, 1, 3, 3, 5});
}
