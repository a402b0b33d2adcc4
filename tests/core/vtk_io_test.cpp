// VTK's formats: every encoding of a file gives the same mesh and arrays, to the last bit.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/corpus.h"

using namespace morsel;
using namespace morsel::test;
using core::LoadedSoup;
using core::VertexProperty;

namespace {

LoadedSoup read_corpus(const std::string& name) {
  return core::read_polygon_soup(corpus_folder() + "/meshes/" + name);
}

const std::vector<double>& values_named(const std::vector<VertexProperty>& properties,
                                        const std::string& name) {
  for (const VertexProperty& property : properties)
    if (property.name == name) return property.values;
  throw std::runtime_error("no property " + name);
}

std::vector<std::string> names_of(const std::vector<VertexProperty>& properties) {
  std::vector<std::string> names;
  for (const VertexProperty& property : properties) names.push_back(property.name);
  return names;
}

constexpr const char* kHead = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\n";
constexpr const char* kTriangle = "POINTS 3 double\n0.1 -0 1e300\n1 0 0\n0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";

LoadedSoup parsed_vtk(const std::string& rest) {
  return core::parse_polygon_soup(kHead + rest, core::MeshFormat::vtk, "test.vtk");
}

}  // namespace

TEST_CASE("every encoding of VTK's files gives the same tetrahedron") {
  for (const char* name :
       {"ascii.vtk", "byte_order_mark.vtk", "old_mac_line_ends.vtk", "binary_old_mac_line_ends.vtk",
        "binary.vtk", "ascii_5_1.vtk", "binary_5_1.vtk", "ascii.vtp", "inline.vtp", "inline_big_64.vtp",
        "inline_zlib.vtp", "appended_base64.vtp", "appended_raw.vtp", "appended_raw_zlib_big.vtp",
        "lines_and_vertices.vtk", "lines_and_vertices.vtp"}) {
    INFO(name);
    const LoadedSoup loaded = read_corpus(name);
    CHECK(loaded.soup.positions == std::vector<core::Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    CHECK(loaded.soup.corners == std::vector<core::Index>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
    CHECK(loaded.soup.offsets == std::vector<std::size_t>{0, 3, 6, 9, 12});
    CHECK(names_of(loaded.properties) ==
          std::vector<std::string>{"height", "a vector:0", "a vector:1", "a vector:2"});
    CHECK(values_named(loaded.properties, "height")[0] == -0.1);
    CHECK(values_named(loaded.properties, "height")[3] == Approx(0.2).epsilon(1e-15));
    CHECK(values_named(loaded.properties, "a vector:1") == std::vector<double>{0, 0.5, 1, 1.5});
    CHECK(values_named(loaded.properties, "a vector:2") == std::vector<double>{0, -1, -2, -3});
    const bool has_lines = std::string(name).starts_with("lines");
    // Cells of vertices and lines come first, of which there is one and two.
    CHECK(values_named(loaded.face_properties, "part") ==
          (has_lines ? std::vector<double>{20, 27, 34, 41} : std::vector<double>{-1, 6, 13, 20}));
    CHECK(loaded.warnings.size() == (has_lines ? 1 : 0));
    if (has_lines) CHECK(loaded.warnings[0].find("1 vertex cell and 2 lines were left out") == 0);
  }
}

TEST_CASE("a grid of faces of all kinds is read, pixels round their corners") {
  for (const char* name : {"grid.vtk", "grid_binary_5_1.vtk", "grid.vtu", "grid_zlib.vtu"}) {
    INFO(name);
    const LoadedSoup loaded = read_corpus(name);
    CHECK(loaded.soup.corners == std::vector<core::Index>{0, 1, 3, 2, 1, 4, 5, 3, 4, 6, 5, 6, 7, 5});
    CHECK(loaded.soup.offsets == std::vector<std::size_t>{0, 4, 8, 11, 14});
    CHECK(values_named(loaded.face_properties, "part") == std::vector<double>{-1, 6, 20, 27});
    CHECK(loaded.warnings == std::vector<std::string>{"1 line was left out: faces are read"});
  }
}

TEST_CASE("a triangle strip turns every second triangle") {
  for (const char* name : {"strip.vtk", "strip.vtp"})
    CHECK(read_corpus(name).soup.corners == std::vector<core::Index>{0, 2, 1, 1, 2, 3, 1, 3, 0, 0, 3, 2});
}

TEST_CASE("volume meshes and curved faces are refused with what would help") {
  CHECK_THROWS_WITH(read_corpus("volume.vtk"),
                    Catch::Contains("1 of its 2 cells are solid (cell 0 is a tetrahedron)") &&
                        Catch::Contains("Extract Surface"));
  CHECK_THROWS_WITH(read_corpus("volume.vtu"), Catch::Contains("it is a volume mesh"));
  CHECK_THROWS_WITH(read_corpus("curved.vtu"), Catch::Contains("a quadratic triangle"));
  CHECK_THROWS_WITH(read_corpus("lz4.vtp"), Catch::Contains("vtkLZ4DataCompressor"));
  CHECK_THROWS_WITH(read_corpus("lzma.vtp"), Catch::Contains("vtkLZMADataCompressor"));
}

TEST_CASE("all attributes of a legacy file are properties, texts are left out") {
  const LoadedSoup loaded = read_corpus("many_attributes.vtk");
  CHECK(names_of(loaded.properties) == std::vector<std::string>{"height", "n:0", "n:1", "n:2", "uv:0", "uv:1",
                                                                "rgb:0", "rgb:1", "rgb:2", "level"});
  CHECK(values_named(loaded.properties, "level") == std::vector<double>{-1, 0, 1, 2});
  CHECK(values_named(loaded.face_properties, "part") == std::vector<double>{1, 2, 3, 4});
  CHECK(loaded.warnings == std::vector<std::string>{"the array \"name\" has texts and was left out"});
}

TEST_CASE("numbers of legacy text have the precision of their type") {
  const core::LoadedSoup loaded =
      parsed_vtk(std::string(kTriangle) +
                 "POINT_DATA 3\nSCALARS f float\nLOOKUP_TABLE default\n0.1 nan -inf\nSCALARS d double\n"
                 "LOOKUP_TABLE default\n0.1 1e-320 +3\n");
  CHECK(loaded.soup.positions[0].x() == 0.1);
  CHECK(std::signbit(loaded.soup.positions[0].y()));
  CHECK(loaded.soup.positions[0].z() == 1e300);
  CHECK(loaded.properties[0].values[0] == static_cast<double>(0.1f));
  CHECK(std::isnan(loaded.properties[0].values[1]));
  CHECK(loaded.properties[0].values[2] == -INFINITY);
  CHECK(loaded.properties[1].values == std::vector<double>{0.1, 1e-320, 3});
}

TEST_CASE("damaged legacy files are refused with the line") {
  const auto refused = [](const std::string& rest) -> std::string {
    try {
      parsed_vtk(rest);
    } catch (const core::BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  const std::string t = kTriangle;
  CHECK_THAT(refused("POINTS 3 double\n0 0 x"), Catch::Contains("line 5: the file is too short"));
  CHECK_THAT(refused("POINTS 1 double\n0 0 x\n"),
             Catch::Contains("line 6: expected a coordinate, found \"x\""));
  std::string old_mac = kHead + t + "POINT_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n1 x 3\n";
  std::ranges::replace(old_mac, '\n', '\r');
  CHECK_THROWS_WITH(core::parse_polygon_soup(old_mac, core::MeshFormat::vtk, "test.vtk"),
                    Catch::Contains("line 14: expected") && Catch::Contains("found \"x\""));
  CHECK_THAT(refused(t + t), Catch::Contains("line 11: \"POINTS\" comes twice"));
  CHECK_THAT(refused(t + "POINT_DATA 3\n"), Catch::Contains("ends before the arrays"));
  CHECK_THAT(refused(t + "POINT_DATA 3\nSCALARS a real\n1 2 3\n"), Catch::Contains("\"real\" are not known"));
  CHECK_THAT(refused(t + "POINT_DATA 2\nSCALARS a int\n1 2\n"), Catch::Contains("is for 2, but there are 3"));
  CHECK_THAT(refused("POINTS 0 float\nPOLYGONS 1 2\n1 0\n"), Catch::Contains("only 0 points"));
}

TEST_CASE("pieces of a VTP file are joined, and arrays that are not in all of them left out") {
  const LoadedSoup loaded = read_corpus("two_pieces.vtp");
  CHECK(loaded.soup.positions.size() == 8);
  CHECK(loaded.soup.corners.back() == 7);
  CHECK(names_of(loaded.properties) == std::vector<std::string>{"a"});
  CHECK(loaded.properties[0].values == std::vector<double>{1, 2, 3, 4, 5, 6, 7, -8});
  CHECK(loaded.warnings ==
        std::vector<std::string>{"the array \"b\" of its points is not in all pieces and was left out"});
}

TEST_CASE("of two arrays of one name the first is taken, with a warning, in both of VTK's formats") {
  const LoadedSoup legacy =
      parsed_vtk(std::string(kTriangle) +
                 "POINT_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3\n"
                 "FIELD f 3\na 1 3 int\n4 5 6\nb 2 3 int\n1 2 3 4 5 6\nb:1 1 3 int\n7 8 9\n");
  CHECK(names_of(legacy.properties) == std::vector<std::string>{"a", "b:0", "b:1"});
  CHECK(values_named(legacy.properties, "a") == std::vector<double>{1, 2, 3});
  CHECK(values_named(legacy.properties, "b:1") == std::vector<double>{2, 4, 6});
  const std::string twice = "the array \"a\" of its points comes twice; the second one was left out";
  CHECK(legacy.warnings ==
        std::vector<std::string>{twice,
                                 "the array \"b:1\" of its points has the component \"b:1\", which another "
                                 "array has, too; the second one was left out"});
  const LoadedSoup xml = core::parse_polygon_soup(
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><PointData>"
      "<DataArray type=\"Int8\" Name=\"a\">1 2 3</DataArray><DataArray type=\"Int8\" Name=\"a\">4 5 6"
      "</DataArray></PointData><Points><DataArray type=\"Int8\" format=\"ascii\">0 0 0 1 0 0 0 1 "
      "0</DataArray>"
      "</Points><Polys><DataArray type=\"Int8\" Name=\"connectivity\">0 1 2</DataArray>"
      "<DataArray type=\"Int8\" Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>",
      core::MeshFormat::vtp, "test.vtp");
  CHECK(values_named(xml.properties, "a") == std::vector<double>{1, 2, 3});
  CHECK(xml.warnings == std::vector<std::string>{twice});
}

TEST_CASE("very many arrays, pieces, attributes and levels of a VTK file take time in proportion") {
  constexpr std::size_t kMany = 100'000;
  const std::string start = "<VTKFile type=\"PolyData\"><PolyData>";
  const std::string piece =
      "<Points><DataArray type=\"Int8\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>"
      "<Polys><DataArray type=\"Int8\" Name=\"connectivity\">0 1 2</DataArray>"
      "<DataArray type=\"Int8\" Name=\"offsets\">3</DataArray></Polys></Piece>";
  const std::string open = "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">";
  const std::string end = "</PolyData></VTKFile>";
  const auto parsed_vtp = [](const std::string& text) {
    return core::parse_polygon_soup(text, core::MeshFormat::vtp, "test.vtp");
  };
  std::string arrays = start + open + "<PointData>";
  std::string pieces = start;
  std::string attributes = kHead + std::string(kTriangle) + "POINT_DATA 3\n";
  for (std::size_t i = 0; i < kMany; ++i) {
    const std::string name = "a" + std::to_string(i);
    arrays += "<DataArray type=\"Int8\" Name=\"" + name + "\">1 2 3</DataArray>";
    pieces += open + piece;
    attributes += "SCALARS " + name + " int\nLOOKUP_TABLE default\n1 2 3\n";
  }
  CHECK(parsed_vtp(arrays + "</PointData>" + piece + end).properties.size() == kMany);
  CHECK(parsed_vtp(pieces + end).soup.polygon_count() == kMany);
  CHECK(core::parse_polygon_soup(attributes, core::MeshFormat::vtk, "test.vtk").properties.size() == kMany);
  std::string deep = start;
  for (std::size_t i = 0; i < 10 * kMany; ++i) deep += "<a>";
  CHECK_THROWS_WITH(parsed_vtp(deep), Catch::Contains("no whole XML document"));
  for (std::size_t i = 0; i < 10 * kMany; ++i) deep += "</a>";
  CHECK(parsed_vtp(deep + end).soup.polygon_count() == 0);
}
