// Terrain: exact tiny grids, gaps, and a slow reference that makes every triangle and lets --repair split.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/elevation_grid.h"
#include "morsel/core/io/geotiff.h"
#include "morsel/core/io/mesh_formats.h"
#include "morsel/core/parallel/parallel.h"

using namespace morsel;
using core::Index;
using core::LoadedSoup;
using core::Point;

namespace {

constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

LoadedSoup read(const std::string& text) {
  return core::parse_polygon_soup(text, core::MeshFormat::asc, "test");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const core::BadInput& error) {
    return error.what();
  }
  return "";
}

const std::string kHeader = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -1\n";

core::ElevationGrid grid(std::size_t columns, const std::vector<double>& values) {
  core::ElevationGrid result;
  result.columns = columns;
  result.rows = values.size() / columns;
  result.first = {0, 0};
  result.along_row = {1, 0};
  result.to_next_row = {0, -1};
  result.values = values;
  return result;
}

/// The triangles of squares in the order that the header states, on all samples.
core::PolygonSoup slow_soup(const core::ElevationGrid& grid) {
  core::PolygonSoup soup;
  for (std::size_t r = 0; r < grid.rows; ++r)
    for (std::size_t c = 0; c < grid.columns; ++c)
      soup.positions.emplace_back(static_cast<double>(c), -static_cast<double>(r),
                                  grid.values[r * grid.columns + c]);
  for (std::size_t r = 0; r + 1 < grid.rows; ++r)
    for (std::size_t c = 0; c + 1 < grid.columns; ++c) {
      const auto at = [&](std::size_t down, std::size_t right) {
        return static_cast<Index>((r + down) * grid.columns + c + right);
      };
      const std::array<Index, 4> around = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};  // counter-clockwise
      std::vector<Index> with_data;
      for (const Index v : around)
        if (!std::isnan(grid.values[v])) with_data.push_back(v);
      if (with_data.size() == 3) soup.add_polygon(with_data);
      if (with_data.size() != 4) continue;
      soup.add_polygon(std::array{around[0], around[1], around[2]});
      soup.add_polygon(std::array{around[0], around[2], around[3]});
    }
  return soup;
}

using Corners = std::array<std::array<double, 3>, 3>;

/// Triangles by their corners' positions, in order, and the vertices.
std::vector<Corners> corners(const core::TriangleMesh& mesh) {
  std::vector<Corners> result;
  for (const core::Triangle& triangle : mesh.triangles()) {
    Corners places;
    for (std::size_t i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) places[i][axis] = mesh.position(triangle[i])[axis];
    std::rotate(places.begin(), std::ranges::min_element(places), places.end());
    result.push_back(places);
  }
  return result;
}

}  // namespace

TEST_CASE("a grid of 3 by 2 cells is four triangles that face up") {
  const LoadedSoup loaded = read(kHeader + "1 2 3\n4 5 6\n");
  const std::vector<Point> expected = {{11, 23, 1}, {13, 23, 2}, {15, 23, 3},
                                       {11, 21, 4}, {13, 21, 5}, {15, 21, 6}};
  CHECK(loaded.soup.positions == expected);
  CHECK(loaded.soup.corners == std::vector<Index>{0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2});
  REQUIRE(loaded.properties.size() == 1);
  CHECK(loaded.properties[0].name == "elevation");
  CHECK(loaded.properties[0].values == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(loaded.warnings.empty());
  const core::TriangleMesh mesh = core::build_mesh(loaded.soup).mesh;
  mesh.validate();
  for (const core::Triangle& t : mesh.triangles()) {
    const Point a = mesh.position(t[1]) - mesh.position(t[0]);
    CHECK(a.cross(mesh.position(t[2]) - mesh.position(t[0])).z() > 0);
  }
}

TEST_CASE("the header of a grid in any order, case and white space") {
  const LoadedSoup expected = read(kHeader + "1 2 3\n4 5 6\n");
  for (const std::string text :
       {"NROWS 2 NCOLS 3 CELLSIZE 2 XLLCENTER 11 YLLCENTER 21 1 2 3 4 5 6",
        "nodata_value nan\r\ncellsize\t2\r\nyllcorner\n20\nXLLCorner 10\n\nnrows 2.0\n ncols 3\n1\n2 3 4\n5 "
        "6\r\n",
        "ncols 3\nnrows 2\nxllcentre 11\nyllcentre 21\ndx 2\ndy 2\n1 2 3 4 5 6\n",
        "\xEF\xBB\xBFncols 3\rnrows 2\rxllcorner 10\ryllcorner 20\rcellsize 2\r1 2 3\r4 5 6\r"}) {
    INFO(text);
    const LoadedSoup loaded = read(text);
    CHECK(loaded.soup.positions == expected.soup.positions);
    CHECK(loaded.soup.corners == expected.soup.corners);
  }
  const LoadedSoup oblong = read("ncols 2 nrows 2 xllcorner 0 yllcorner 0 dx 2 dy 4\n1 2 3 4");
  CHECK(oblong.soup.positions == std::vector<Point>{{1, 6, 1}, {3, 6, 2}, {1, 2, 3}, {3, 2, 4}});
}

TEST_CASE("cells without data are left out, and what they leave without a triangle") {
  // A square of three makes one triangle, whichever is missing.
  const std::array<std::vector<Index>, 4> expected = {
      {{1, 2, 0}, {0, 1, 2}, {0, 2, 1}, {0, 2, 1}}};  // of the vertices that are left
  for (std::size_t missing = 0; missing < 4; ++missing) {
    std::vector<double> values = {1, 2, 3, 4};
    values[missing] = kNoData;
    const LoadedSoup loaded = core::make_terrain(grid(2, values), "test", {});
    INFO(missing);
    CHECK(loaded.soup.positions.size() == 3);
    CHECK(loaded.soup.corners == expected[missing]);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(loaded.warnings[0] == "1 of 4 cells have no data and are left out");
  }
  const LoadedSoup loaded = read(kHeader + "1 2 -1\n4 5 -1.0\n");
  CHECK(loaded.soup.positions.size() == 4);
  CHECK(loaded.properties[0].values == std::vector<double>{1, 2, 4, 5});
  const LoadedSoup alone =
      read("ncols 5 nrows 2 xllcorner 0 yllcorner 0 cellsize 1\n1 2 -9999 -9999 3\n1 2 -9999 nan 3");
  CHECK(alone.soup.positions.size() == 4);
  REQUIRE(alone.warnings.size() == 1);
  CHECK(alone.warnings[0] ==
        "4 of 10 cells have no data and are left out, and with them 2 that no triangle reaches: "
        "a triangle needs three cells of a square of four");
}

TEST_CASE("a cell where two gaps meet at a corner is split") {
  const LoadedSoup loaded = core::make_terrain(grid(3, {kNoData, 2, 3,        //
                                                        kNoData, 5, kNoData,  //
                                                        7, 8, kNoData}),
                                               "test", {});
  CHECK(loaded.properties[0].values == std::vector<double>{2, 3, 5, 7, 8, 5});
  CHECK(loaded.soup.positions[2] == loaded.soup.positions[5]);
  CHECK(loaded.soup.corners == std::vector<Index>{0, 2, 1, 3, 4, 5});
  CHECK(loaded.warnings ==
        std::vector<std::string>{
            "4 of 9 cells have no data and are left out",
            "1 cell where gaps meet at a corner was split: it became 2 vertices, as the surface "
            "is joined at a point there"});
  CHECK(core::build_mesh(loaded.soup).mesh.component_count() == 2);
}

TEST_CASE("split cells are those that repair would split") {
  std::mt19937 random(19);
  std::size_t splits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t columns = 2 + random() % 9, rows = 2 + random() % 9;
    std::vector<double> values(columns * rows);
    const unsigned share = random() % 70;
    for (double& value : values)
      value = random() % 100 < share ? kNoData : static_cast<double>(random() % 50);
    const core::ElevationGrid terrain = grid(columns, values);
    const core::PolygonSoup slow = slow_soup(terrain);
    if (slow.polygon_count() == 0) {
      CHECK_THROWS_AS(core::make_terrain(terrain, "test", {}), core::BadInput);
      continue;
    }
    const LoadedSoup loaded = core::make_terrain(terrain, "test", {});
    const core::BuiltMesh built = core::build_mesh(loaded.soup);
    built.mesh.validate();
    CHECK(built.numbering.to_input.empty());
    const core::BuiltMesh expected = core::build_mesh(slow, {.repair = true});
    CHECK(built.mesh.vertex_count() == expected.mesh.vertex_count());
    CHECK(built.mesh.component_count() == expected.mesh.component_count());
    CHECK(built.mesh.boundary_loop_count() == expected.mesh.boundary_loop_count());
    CHECK(corners(built.mesh) == corners(expected.mesh));
    for (const core::Repair& repair : expected.repairs)
      if (repair.action == "split_non_manifold_vertices") splits += repair.count;
  }
  CHECK(splits > 100);
}

TEST_CASE("a terrain that is turned, or whose rows go up, faces up") {
  for (const auto& [along, down] : std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>{
           {{1, 0}, {0, 1}}, {{-1, 0}, {0, -1}}, {{0.5, 0.5}, {0.5, -0.5}}, {{0, 2}, {3, 1}}}) {
    core::ElevationGrid terrain = grid(2, {0, 0, 0, 0});
    terrain.along_row = along;
    terrain.to_next_row = down;
    const core::TriangleMesh mesh = core::build_mesh(core::make_terrain(terrain, "test", {}).soup).mesh;
    for (const core::Triangle& t : mesh.triangles()) {
      const Point a = mesh.position(t[1]) - mesh.position(t[0]);
      CHECK(a.cross(mesh.position(t[2]) - mesh.position(t[0])).z() > 0);
    }
  }
  core::ElevationGrid flat = grid(2, {0, 0, 0, 0});
  flat.to_next_row = {2, 0};
  CHECK_THROWS_WITH(core::make_terrain(flat, "test", {}), Catch::Contains("no area"));
}

TEST_CASE("a grid in pieces, by threads, has the same bits and errors") {
  std::mt19937 random(5);
  std::string text = "ncols 17 nrows 23 xllcorner 0.1 yllcorner 0.7 cellsize 0.3\n";
  for (int i = 0; i < 17 * 23; ++i)
    text +=
        (random() % 9 == 0 ? "-9999" : std::to_string(random() % 1000) + ".25") + (i % 17 == 16        ? "\n"
                                                                                   : random() % 5 == 0 ? "\n "
                                                                                                       : " ");
  const core::ThreadLimit two(2);
  const LoadedSoup whole = core::read_asc(text, "test", {}, text.size());
  for (const std::size_t chunk : {1, 10, 100, 1000}) {
    const LoadedSoup pieces = core::read_asc(text, "test", {}, chunk);
    CHECK(pieces.soup.positions == whole.soup.positions);
    CHECK(pieces.soup.corners == whole.soup.corners);
  }
  const std::string broken = text.substr(0, text.size() - 9) + " x 1 2 3\n";
  std::string first, second;
  try {
    core::read_asc(broken, "test", {}, broken.size());
  } catch (const core::BadInput& error) {
    first = error.what();
  }
  try {
    core::read_asc(broken, "test", {}, 10);
  } catch (const core::BadInput& error) {
    second = error.what();
  }
  CHECK(!first.empty());
  CHECK(first == second);
}

TEST_CASE("grids that are none say why") {
  const std::string numbers = "1 2 3\n4 5 6\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "it ends at line 0, within the header"},
      {"ncols 3\nnrows 2\n", "within the header"},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\n" + numbers, "neither cellsize nor dx"},
      {"ncols 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "has no nrows"},
      {"ncols 3\nnrows 2\nyllcorner 0\ncellsize 1\n" + numbers,
       "one of xllcorner and xllcenter, and has neither"},
      {"ncols 3\nnrows 2\nxllcorner 0\nxllcenter 0\nyllcorner 0\ncellsize 1\n" + numbers, "and has both"},
      {"ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n" + numbers, "cellsize is not positive"},
      {"ncols 3\nnrows 2\nxllcorner inf\nyllcorner 0\ncellsize 1\n" + numbers, "xllcorner is not finite"},
      {"ncols 3\nncols 3\n" + numbers, "line 2: the header has ncols twice"},
      {"ncols 3\nnorth: 5\n", "line 2: the header of an ESRI ASCII grid has ncols"},
      {"ncols 3\nnrows two\n", "line 2: expected the value of nrows, found \"two\""},
      {"ncols 1\nnrows 6\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "6 rows and 1 column"},
      {"ncols -3\nnrows 6\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "ncols is no number of cells"},
      {"ncols 2.5\nnrows 6\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "ncols is no number of cells"},
      {"ncols 60000\nnrows 60000\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "too short"},
      {"ncols 70000\nnrows 70000\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + numbers, "can be numbered"},
      {kHeader + "10 20 30\n40 50\n", "after 5 of 6 values"},
      {kHeader + "1 2 3\n4 5 6 7\n", "goes on after the 6 values"},
      {kHeader + "1 2 3\n4 5,5 6\n", "line 8: expected an elevation, found \"5,5\""},
      {kHeader + "1 2 3\n4 inf 6\n", "row 2 and column 2 is infinite"},
      {kHeader + "1 -1 3\n-1 -1 -1\n", "so that there is no triangle"},
  };
  for (const auto& [text, sentence] : cases) {
    INFO(text);
    CHECK_THAT(refusal(text), Catch::Contains(sentence) && Catch::StartsWith("cannot read \"test\": "));
  }
}

TEST_CASE("a grid in degrees is warned of") {
  CHECK(read("ncols 2 nrows 2 xllcorner 8 yllcorner 46 cellsize 0.001\n400 500 600 700")
            .warnings.at(0)
            .find("as if its positions were degrees") != std::string::npos);
  CHECK(read("ncols 2 nrows 2 xllcorner 8 yllcorner 46 cellsize 90\n400 500 600 700").warnings.empty());
}

TEST_CASE("values of no data that were written with fewer digits") {
  const LoadedSoup loaded = read(
      "ncols 3 nrows 2 xllcorner 0 yllcorner 0 cellsize 1 NODATA_value "
      "-3.4028234663852886e+38\n1 2 -3.40282e+38 4 5 6");
  CHECK(loaded.soup.positions.size() == 5);
}

TEST_CASE("a GeoTIFF of more cells than its size allows is refused") {
  // One strip of `rows` rows, compressed by deflate, of which there are no bytes to speak of.
  const auto refusal_of = [](std::uint32_t columns, std::uint32_t rows) -> std::string {
    std::string bytes("II*\0\x10\0\0\0", 8);
    bytes += std::string("\x78\x9C\x03\0\0\0\0\x01", 8);
    const std::array<std::array<std::uint32_t, 2>, 9> entries = {{{256, columns},
                                                                  {257, rows},
                                                                  {258, 8},
                                                                  {259, 8},
                                                                  {262, 1},
                                                                  {273, 8},
                                                                  {277, 1},
                                                                  {278, rows},
                                                                  {279, 8}}};
    const auto append = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
    };
    append(entries.size(), 2);
    for (const auto& [tag, value] : entries) {
      append(tag, 2);
      append(4, 2);
      append(1, 4);
      append(value, 4);
    }
    append(0, 4);
    try {
      core::read_geotiff(bytes, "bomb.tif", {});
    } catch (const core::BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  std::string too_many, no_data;
  try {
    too_many = refusal_of(8'000, 5'000);
    no_data = refusal_of(100, 50);
  } catch (const core::InvalidArgument&) {  // a library without GeoTIFF
    return;
  }
  CHECK_THAT(too_many,
             Catch::Contains("expand to more than 256 MiB") && Catch::Contains("at 40000000 cells"));
  CHECK_THAT(no_data, Catch::Contains("its rows 1 to 50 cannot be read"));
}
