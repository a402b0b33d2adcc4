// Vertices that are left out of a mesh: by a mask or because a field has no value there.

#include "morsel/core/io/vertex_mask.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/vertex_removal.h"
#include "support/meshes.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::BuiltMesh;
using core::kNone;
using core::PolygonSoup;
using core::VertexValues;

namespace {

/// columns × rows vertices, all squares between them.
PolygonSoup squares(Index columns, Index rows) {
  PolygonSoup result;
  for (Index y = 0; y < rows; ++y)
    for (Index x = 0; x < columns; ++x) result.positions.emplace_back(x, y, 0);
  for (Index y = 0; y + 1 < rows; ++y)
    for (Index x = 0; x + 1 < columns; ++x) {
      const Index v = y * columns + x;
      result.add_polygon(std::vector<Index>{v, v + 1, v + columns + 1, v + columns});
    }
  return result;
}

std::vector<bool> mask_of(std::size_t count, const std::set<Index>& out) {
  std::vector<bool> left_out(count, false);
  for (const Index v : out) left_out[v] = true;
  return left_out;
}

std::string repairs_of(const std::vector<core::Repair>& repairs) {
  std::string text;
  for (const core::Repair& r : repairs)
    text += (text.empty() ? "" : ", ") + r.action + " " + std::to_string(r.count);
  return text;
}

/// The fans of faces around each vertex, by joining faces at a common side until nothing changes.
std::map<Index, std::size_t> slowly_counted_fans(const std::vector<core::Triangle>& faces) {
  std::map<Index, std::vector<core::Triangle>> at;
  for (const core::Triangle& t : faces)
    for (const Index v : t) at[v].push_back(t);
  std::map<Index, std::size_t> fans;
  for (const auto& [v, around] : at) {
    std::vector<std::set<Index>> parts;
    for (const core::Triangle& t : around) {
      std::set<Index> part(t.begin(), t.end());
      part.erase(v);
      for (bool grown = true; grown;) {
        grown = false;
        for (std::size_t i = 0; i < parts.size() && !grown; ++i)
          if (std::ranges::any_of(parts[i], [&](Index w) { return part.contains(w); })) {
            part.insert(parts[i].begin(), parts[i].end());
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
            grown = true;
          }
      }
      parts.push_back(part);
    }
    fans[v] = parts.size();
  }
  return fans;
}

std::string error_of(const std::string& ply, const core::BuildOptions& options) {
  try {
    core::make_mesh(core::parse_polygon_soup(ply, core::MeshFormat::ply, "m.ply"), "m.ply", options);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

/// A strip of four squares with two properties.
std::string strip() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\n"
      "property float inside\nproperty float depth\nelement face 4\nproperty list uchar int vertex_indices\n"
      "end_header\n";
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 2; ++y)
      text += std::to_string(x) + " " + std::to_string(y) + " 0 " + (x < 4 ? "1 " : "0 ") +
              (x == 0 && y == 0 ? "nan" : std::to_string(x)) + "\n";
  for (int x = 0; x < 4; ++x) {
    const int v = 2 * x;
    text += "4 " + std::to_string(v) + " " + std::to_string(v + 2) + " " + std::to_string(v + 3) + " " +
            std::to_string(v + 1) + "\n";
  }
  return text;
}

core::LoadedMesh strip_with(const core::BuildOptions& options) {
  return core::make_mesh(core::parse_polygon_soup(strip(), core::MeshFormat::ply, "m.ply"), "m.ply", options);
}

}  // namespace

TEST_CASE("without a vertex its faces are gone") {
  const BuiltMesh built = core::build_mesh(squares(5, 5), {}, {}, mask_of(25, {12}));
  CHECK(built.mesh.vertex_count() == 24);
  CHECK(built.mesh.triangle_count() == 2 * (16 - 4));
  CHECK(built.mesh.boundary_loop_count() == 2);
  CHECK(built.numbering.input_count == 25);
  CHECK(built.numbering.input_vertex(11) == 11);
  CHECK(built.numbering.input_vertex(12) == 13);
  CHECK(built.numbering.mesh_vertex(12) == kNone);
  CHECK(built.numbering.mesh_vertex(24) == 23);
  CHECK(repairs_of(built.repairs) == "left_out_vertices 1, left_out_faces 4");
  // The corner 0 is used by a face that is gone alone.
  const BuiltMesh corner = core::build_mesh(squares(4, 4), {}, {}, mask_of(16, {1, 4}));
  CHECK(corner.numbering.mesh_vertex(0) == kNone);
  CHECK(repairs_of(corner.repairs) == "left_out_vertices 3, left_out_faces 3");
  CHECK(corner.warnings == std::vector<std::string>{"3 of 16 vertices and 3 faces were left out, 1 vertex "
                                                    "because no face is left there"});
  CHECK(core::build_mesh(squares(3, 3), {}, {}, mask_of(9, {})).repairs.empty());
}

TEST_CASE("faces that a gap leaves at a point alone get vertices of their own") {
  // Of four squares two remain, which meet in the middle.
  const BuiltMesh built = core::build_mesh(squares(3, 3), {}, {}, mask_of(9, {2, 6}));
  CHECK(repairs_of(built.repairs) == "left_out_vertices 2, left_out_faces 2, split_left_out_rims 1");
  CHECK(built.mesh.vertex_count() == 8);
  CHECK(built.mesh.component_count() == 2);
  CHECK(built.numbering.input_vertex(7) == 4);
  CHECK(built.numbering.mesh_vertex(4) == 3);
  CHECK(built.warnings.size() == 1);
  CHECK(built.warnings.front().ends_with(
      "; 1 vertex was split where faces that are left meet in a point alone"));
}

TEST_CASE("every surface without any of its vertices is a surface") {
  std::mt19937 random(5);
  for (const NamedMesh& named : mesh_zoo()) {
    const TriangleMesh& mesh = named.mesh;
    if (mesh.vertex_count() > 5000) continue;
    for (const double share : {0.05, 0.3, 0.6}) {
      INFO(named.name << " " << share);
      std::bernoulli_distribution goes(share);
      std::vector<bool> left_out(mesh.vertex_count());
      for (std::size_t v = 0; v < left_out.size(); ++v) left_out[v] = goes(random);
      std::vector<core::Triangle> kept;
      for (const core::Triangle& t : mesh.triangles())
        if (std::ranges::none_of(t, [&](Index v) { return left_out[v]; })) kept.push_back(t);
      PolygonSoup soup;
      soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
      for (const core::Triangle& t : mesh.triangles()) soup.add_polygon(t);
      if (kept.empty()) {
        CHECK_THROWS_AS(core::build_mesh(soup, {}, {}, left_out), core::BadInput);
        continue;
      }
      for (const bool repair : {false, true}) {
        const BuiltMesh built = core::build_mesh(soup, {.repair = repair}, {}, left_out);
        built.mesh.validate();
        REQUIRE(built.mesh.triangle_count() == kept.size());
        std::map<Index, std::size_t> copies;
        for (Index v = 0; v < built.mesh.vertex_count(); ++v) {
          const Index input = built.numbering.input_vertex(v);
          ++copies[input];
          REQUIRE(built.mesh.position(v) == mesh.position(input));
        }
        for (std::size_t t = 0; t < kept.size(); ++t)
          for (int i = 0; i < 3; ++i)
            REQUIRE(built.numbering.input_vertex(built.mesh.triangle(static_cast<Index>(t))[i]) ==
                    kept[t][i]);
        CHECK(copies == slowly_counted_fans(kept));
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
          const Index at = built.numbering.mesh_vertex(v);
          REQUIRE((at == kNone) == !copies.contains(v));
          if (at != kNone) REQUIRE(built.numbering.input_vertex(at) == v);
        }
      }
    }
  }
}

TEST_CASE("what is wrong elsewhere is refused in the input's numbers") {
  // Two tetrahedra that meet in a vertex, and a strip apart of which a vertex goes.
  const Soup tip = tetrahedron();
  Soup both = together(together(grid(4, 2), tip), tip);
  for (core::Triangle& t : both.triangles)
    for (Index& v : t)
      if (v == 12) v = 8;  // the second's first vertex is the first's
  for (Index v = 13; v < 16; ++v) both.positions[v] += Point(0, 0, 9);
  PolygonSoup soup = both.polygons();
  soup.positions[12] = soup.positions[13];
  std::vector<bool> left_out = mask_of(16, {0, 12});
  std::vector<core::Defect> defects;
  try {
    core::build_mesh(soup, {}, {}, left_out);
  } catch (const core::MeshError& error) {
    defects = error.defects();
  }
  REQUIRE(defects.size() == 1);
  CHECK(defects[0].kind == core::DefectKind::non_manifold_vertex);
  CHECK(defects[0].first == std::vector<Index>{8});
  CHECK(core::build_mesh(soup, {.repair = true}, {}, left_out).mesh.component_count() == 3);

  // A degenerate face has the number that it has in the file; an unused vertex stays a defect.
  soup = squares(3, 2);
  soup.add_polygon(std::vector<Index>{2, 5, 5});
  soup.positions.emplace_back(7, 7, 7);
  try {
    core::build_mesh(soup, {}, {}, mask_of(7, {0}));
    FAIL("it is refused");
  } catch (const core::MeshError& error) {
    defects = error.defects();
  }
  REQUIRE(defects.size() == 2);
  CHECK(defects[0].kind == core::DefectKind::degenerate_face);
  CHECK(defects[0].first == std::vector<Index>{2});
  CHECK(defects[1].kind == core::DefectKind::unreferenced_vertex);
  CHECK(defects[1].first == std::vector<Index>{6});
}

TEST_CASE("vertices are left out before others are joined") {
  PolygonSoup soup = squares(3, 3);
  const BuiltMesh whole = core::build_mesh(soup, {}, {}, mask_of(9, {2, 6}));
  for (const Point& p : squares(3, 3).positions)
    soup.positions.push_back(p);  // the same squares again, apart
  for (const std::vector<Index>& p : {std::vector<Index>{9, 10, 13, 12}, std::vector<Index>{13, 14, 17, 16}})
    soup.add_polygon(p);
  std::set<Index> out = {2, 6, 11, 15, 9, 17};
  // What is left of the copies has no face: both squares have a vertex that goes.
  const BuiltMesh built = core::build_mesh(soup, {.weld = core::Length::absolute(0)}, {}, mask_of(18, out));
  CHECK(built.mesh.vertex_count() == whole.mesh.vertex_count());
  CHECK(built.numbering.input_count == 18);
  CHECK(repairs_of(built.repairs) == "left_out_vertices 11, left_out_faces 4, split_left_out_rims 1");
}

TEST_CASE("a mask has an entry for each vertex and leaves a face") {
  CHECK_THROWS_AS(core::build_mesh(squares(3, 3), {}, {}, mask_of(8, {1})), core::InvalidArgument);
  CHECK_THROWS_WITH(core::build_mesh(squares(3, 3), {}, {}, mask_of(9, {4})),
                    "no face is left: each of 4 has a vertex that is left out, as are 1 of 9 vertices");
}

TEST_CASE("a property or a file is a mask") {
  const core::LoadedMesh loaded = strip_with({.mask = VertexValues{"", "inside"}});
  CHECK(loaded.mesh.vertex_count() == 8);
  CHECK(loaded.source.warnings ==
        std::vector<std::string>{"the mask the property \"inside\" is 0 or nan at 2 of 10 vertices",
                                 "2 of 10 vertices and 1 face were left out"});
  const Scratch folder;
  const auto text = folder.file("mask.txt", "1\n1\n1\n1\n1\n1\n1\n1\nnan\n0\n");
  const auto table =
      folder.file("mask.csv", "vertex,keep\n0,1\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n8,0\n9,\n");
  for (const VertexValues& mask : {VertexValues{text, ""}, VertexValues{table, "", "keep"}}) {
    const core::LoadedMesh again = strip_with({.mask = mask});
    CHECK(again.mesh.vertex_count() == 8);
    CHECK(again.source.numbering.to_input == loaded.source.numbering.to_input);
  }
}

TEST_CASE("vertices without a needed value are left out") {
  const core::LoadedMesh loaded = strip_with({.needed = {VertexValues{"", "depth"}}});
  CHECK(loaded.mesh.vertex_count() == 8);
  CHECK(loaded.source.numbering.mesh_vertex(0) == kNone);
  CHECK(
      loaded.source.warnings ==
      std::vector<std::string>{"the property \"depth\" has no value (nan) at 1 of 10 vertices",
                               "2 of 10 vertices and 1 face were left out, 1 vertex because no face is left "
                               "there"});
  // Both, and what the field itself complains of later.
  CHECK(strip_with({.mask = VertexValues{"", "inside"}, .needed = {VertexValues{"", "depth"}}})
            .mesh.vertex_count() == 6);
  for (const VertexValues& values : {VertexValues{"", "length"}, VertexValues{"missing.txt", ""}})
    CHECK(strip_with({.needed = {values}}).source.warnings.empty());
}

TEST_CASE("a mask that cannot be used is refused in a sentence") {
  const Scratch folder;
  const auto file = folder.file("short.txt", "1\n0\n");
  CHECK(error_of(strip(), {.mask = VertexValues{file, ""}}) ==
        "cannot use \"m.ply\": the mask " + file.string() +
            " has 2 values, but the mesh's file has 10 vertices");
  CHECK(
      error_of(strip(), {.mask = VertexValues{"", "out"}}) ==
      "cannot use \"m.ply\": the mask is to be the property \"out\", which the mesh's file does not have for "
      "its vertices; it has inside, depth");
  CHECK(error_of(strip(), {.mask = VertexValues{folder / "none.txt", ""}}).find("none.txt") !=
        std::string::npos);
  CHECK(error_of(strip(), {.mask = VertexValues{"", ""}}).find("name one of them") != std::string::npos);
}

TEST_CASE("masks are written as texts and read back") {
  const auto parsed = [](const std::string& text) { return core::parse_vertex_values(text, "--mask"); };
  CHECK(parsed("a/b,c.txt") == VertexValues{"a/b,c.txt", ""});
  CHECK(parsed("file=a.csv,column=in") == VertexValues{"a.csv", "", "in"});
  CHECK(parsed("property=a=b") == VertexValues{"", "a=b"});
  for (const VertexValues& values :
       {VertexValues{"a,b=\\c", "", "x,y"}, VertexValues{"", "p\\,=q"}, VertexValues{"plain", ""}})
    CHECK(parsed(to_string(values)) == values);
  for (const std::string wrong : {"", "file=", "column=2", "file=a,property=b", "property=b,column=2",
                                  "file=a,file=b", "files=a", "file=a,b"})
    CHECK_THROWS_AS(parsed(wrong), core::InvalidArgument);
}
