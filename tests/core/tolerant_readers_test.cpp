// What readers take although it is odd, and what they say of it. Whole files are in the corpus, too.

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"

using namespace morsel::core;
using Catch::Contains;

namespace {

using Polygons = std::vector<std::vector<Index>>;
using Warnings = std::vector<std::string>;

LoadedSoup parsed_text(const std::string& text, MeshFormat format) {
  return parse_polygon_soup(text, format, "test");
}

Polygons polygons(const LoadedSoup& loaded) {
  Polygons result;
  for (std::size_t p = 0; p < loaded.soup.polygon_count(); ++p)
    result.emplace_back(loaded.soup.polygon(p).begin(), loaded.soup.polygon(p).end());
  return result;
}

const std::string kPlyVertices = "property float x\nproperty float y\nproperty float z\n";

std::string strips_of(const std::string& lines, int count) {
  return "ply\nformat ascii 1.0\nelement vertex 6\n" + kPlyVertices + "element tristrips " +
         std::to_string(count) + "\nproperty list int int vertex_indices\nend_header\n" +
         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n" + lines;
}

/// A binary STL file of one triangle a number.
std::string stl_of(std::uint32_t announced, int triangles, const std::string& tail) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(announced);
  for (int t = 0; t < triangles; ++t) {
    for (const float number : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f + t, 0.0f})
      append(number);
    append(std::uint16_t{0});
  }
  return bytes + tail;
}

}  // namespace

TEST_CASE("numbers of an OFF file may be on any lines") {
  // The same numbers, with another blank or line's end after each.
  const std::vector<std::string> numbers = {"3", "2", "3", "0", "0", "0.5", "1", "0", "0", "0",
                                            "1", "0", "3", "0", "1", "2",   "3", "2", "1", "0"};
  std::mt19937 random(3);
  for (int run = 0; run < 500; ++run) {
    std::string text = "OFF\n3 2 3\n";
    for (std::size_t i = 3; i < numbers.size(); ++i) {
      static const std::vector<std::string> kBetween = {" ", "\n", "\t", "\r\n", "\n\n", " # comment\n"};
      text += numbers[i] + kBetween[random() % (run < 10 ? 2 : kBetween.size())];
    }
    INFO(text);
    const LoadedSoup loaded = parsed_text(text, MeshFormat::off);
    CHECK(loaded.soup.positions == std::vector<Point>{{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}});
    CHECK(polygons(loaded) == Polygons{{0, 1, 2}, {2, 1, 0}});
    CHECK(loaded.warnings.empty());
  }
}

TEST_CASE("an OFF file that has too few numbers or others is refused in one sentence") {
  const auto read = [](const std::string& rest) {
    return parsed_text("OFF\n3 1 0\n" + rest, MeshFormat::off);
  };
  CHECK(polygons(read("0 0 0 1 0 0\n0 1 0 3\n0 1 2")) == Polygons{{0, 1, 2}});
  CHECK_THROWS_WITH(read("0 0 0 1 0 0\n0 1 0 3\n0 1"), Contains("it ends at line 5, after 0 of 1 faces"));
  CHECK_THROWS_WITH(read("0 0 0 1 0 0\n0 1      "), Contains("it ends at line 4, after 2 of 3 vertices"));
  CHECK_THROWS_WITH(read("0 0 0 1 0 0\n0 1 0\n3 0 1"), Contains("it ends at line 5, after 0 of 1 faces"));
  CHECK_THROWS_WITH(read("0 0 0 1 0 0\n0 1 0\n3 0 1 3"), Contains("line 5: face 0 names vertex 3"));
  CHECK_THROWS_WITH(read("0 0 0 1 x 0\n0 1 0\n3 0 1 2"), Contains("line 3: expected a coordinate"));
  // The lines of a file of lines have the error.
  CHECK_THROWS_WITH(read("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), Contains("line 4: the line ends where"));
}

TEST_CASE("colours of faces are skipped only where lines tell them from faces") {
  const std::string vertices = "OFF\n3 2 0\n0 0 0 1 0 0\n0 1 0";
  CHECK(polygons(parsed_text(vertices + "\n3 0 1 2 255 0 0\n3 2 1 0 7\n", MeshFormat::off)) ==
        Polygons{{0, 1, 2}, {2, 1, 0}});
  CHECK_THROWS_WITH(
      parsed_text(vertices + " 3 0 1 2 255 0 0\n3 2 1 0 7\n", MeshFormat::off),
      Contains("line 5: face 1 names vertex 3") && Contains("faces with colours are read only"));
  CHECK_THROWS_WITH(parsed_text(vertices + "\n3 0 1\n2 9 9\n3 2 1 0 7\n", MeshFormat::off),
                    Contains("face 0 goes over several lines, and more follows its corners"));
}

TEST_CASE("lines behind the faces of an OFF file are left out with a warning, in pieces too") {
  std::string text = "OFF\n20000 20000 0\n";
  for (int v = 0; v < 20000; ++v) text += std::to_string(v) + " 0.125 0\n";
  for (int f = 0; f < 20000; ++f) text += "3 0 " + std::to_string(f) + " 1\n";
  text += "# no line\nthe end\n1 2\n";
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const LoadedSoup loaded = parsed_text(text, MeshFormat::off);
    CHECK(loaded.soup.positions.size() == 20000);
    CHECK(loaded.soup.polygon_count() == 20000);
    CHECK(loaded.warnings == Warnings{"2 lines follow the 20,000 vertices and 20,000 faces that its header "
                                      "announces; they are left out"});
  }
}

TEST_CASE("triangle strips are their triangles, every second one turned round") {
  CHECK(polygons(parsed_text(strips_of("6 0 1 2 3 4 5\n", 1), MeshFormat::ply)) ==
        Polygons{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}});
  // -1 begins anew, so that the first triangle is not turned.
  CHECK(polygons(parsed_text(strips_of("9 0 1 2 3 -1 2 3 4 5\n", 1), MeshFormat::ply)) ==
        Polygons{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}});
  CHECK(polygons(parsed_text(strips_of("8 -1 -1 0 1 2 -1 3 4\n3 3 4 5\n", 2), MeshFormat::ply)) ==
        Polygons{{0, 1, 2}, {3, 4, 5}});
  // Repeated vertices join strips; they count for the orientation.
  CHECK(polygons(parsed_text(strips_of("7 0 1 2 2 3 4 5\n", 1), MeshFormat::ply)) ==
        Polygons{{0, 1, 2}, {3, 2, 4}, {3, 4, 5}});
  CHECK_THROWS_WITH(parsed_text(strips_of("3 0 1 6\n", 1), MeshFormat::ply),
                    Contains("a triangle strip names vertex 6, but there are only 6 vertices"));
  CHECK_THROWS_WITH(parsed_text(strips_of("3 0 1 -2\n", 1), MeshFormat::ply), Contains("vertex -2"));
  CHECK_THROWS_WITH(parsed_text(strips_of("3 0 1 2\n", 2), MeshFormat::ply),
                    Contains("after 1 of 2 tristrips"));
}

TEST_CASE("scalar properties of a PLY file's faces are kept by polygon") {
  const LoadedSoup loaded = parsed_text(
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nelement vertex 4\n" +
          kPlyVertices +
          "element face 2\nproperty short label\nproperty list uchar int vertex_indices\nproperty float "
          "area\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n-7 3 0 1 2 0.1\n8 3 3 2 1 nan\n",
      MeshFormat::ply);
  CHECK(polygons(loaded) == Polygons{{0, 1, 2}, {2, 1, 3}, {0, 1, 2}, {3, 2, 1}});
  REQUIRE(loaded.face_properties.size() == 2);
  CHECK(loaded.face_properties[0].name == "label");
  CHECK(std::isnan(loaded.face_properties[0].values[1]));  // a triangle of a strip
  CHECK(loaded.face_properties[0].values[2] == -7);
  CHECK(loaded.face_properties[0].values[3] == 8);
  CHECK(loaded.face_properties[1].name == "area");
  CHECK(loaded.face_properties[1].values[2] == 0.1f);
  CHECK(std::isnan(loaded.face_properties[1].values[3]));
}

TEST_CASE("what is odd in a PLY file is counted in its warnings") {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n" + kPlyVertices +
                           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(parsed_text(head + "3 0 1 2\n3 2 1 0\n", MeshFormat::ply).warnings.empty());
  const LoadedSoup loaded =
      parsed_text(head + "3 0 1 2 7 8\n3 2.0 1 0. 9\nmore\nand more\n", MeshFormat::ply);
  CHECK(polygons(loaded) == Polygons{{0, 1, 2}, {2, 1, 0}});
  CHECK(loaded.warnings ==
        Warnings{"2 face lines go on after the header's properties; what follows there is left out",
                 "2 whole numbers are written with decimals, all of them 0",
                 "2 lines follow the elements that its header announces; they are left out"});
  CHECK_THROWS_WITH(parsed_text(head + "3 0 1 2\n3 2.5 1 0\n", MeshFormat::ply),
                    Contains("expected a whole number, found \"2.5\""));
  CHECK_THROWS_AS(parsed_text(head + "3 0 1 2\n3 1e99 1 0\n", MeshFormat::ply), BadInput);
  CHECK_THROWS_AS(parsed_text(head + "3 0 1 2\n3 2.0x 1 0\n", MeshFormat::ply), BadInput);
  CHECK_THROWS_AS(parsed_text(head + "3 0 1 2 red\n3 2 1 0\n", MeshFormat::ply), BadInput);
}

TEST_CASE("bytes behind the triangles of a binary STL file, or 0 for their number, are said") {
  const LoadedSoup tail = parsed_text(stl_of(2, 2, "tail"), MeshFormat::stl);
  CHECK(tail.soup.polygon_count() == 2);
  CHECK(tail.warnings == Warnings{"4 bytes follow the 2 triangles that its header announces; they are left "
                                  "out"});
  CHECK(parsed_text(stl_of(1, 2, ""), MeshFormat::stl).warnings ==
        Warnings{"50 bytes follow the 1 triangle that its header announces; they are left out"});
  const LoadedSoup zero = parsed_text(stl_of(0, 3, ""), MeshFormat::stl);
  CHECK(zero.soup.polygon_count() == 3);
  CHECK(zero.warnings ==
        Warnings{"its header announces 0 triangles, but it has 3 triangles, which are read"});
  CHECK_THROWS_WITH(parsed_text(stl_of(0, 3, "x"), MeshFormat::stl), Contains("announces 0 triangles"));
  CHECK_THROWS_WITH(parsed_text(stl_of(3, 2, ""), MeshFormat::stl), Contains("announces 3 triangles"));
  CHECK(parsed_text(stl_of(0, 0, ""), MeshFormat::stl).warnings.empty());
}

TEST_CASE("a backslash may follow a word of an OBJ file without a blank") {
  const LoadedSoup loaded =
      parsed_text("v 0 0\\\n0\nv 1 0 0\\\r\n\nv 0 1 0\nf 1/1\\\n2//3 3\\  \n\n", MeshFormat::obj);
  CHECK(loaded.soup.positions == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(polygons(loaded) == Polygons{{0, 1, 2}});
  CHECK_THROWS_AS(parsed_text("v 0 0 0\nf 1\\1 1 1\n", MeshFormat::obj), BadInput);
}

TEST_CASE("a file of another kind is named for what it is") {
  CHECK_THROWS_WITH(parsed_text("v 0 0 0\n", MeshFormat::off),
                    "cannot read \"test\": it is an OBJ file, though the format that was given is off (line "
                    "1: an OFF file begins "
                    "with OFF (or COFF, NOFF, STOFF, …), not with \"v\"): use --format obj");
  CHECK_THROWS_WITH(parsed_text("<html>", MeshFormat::obj),
                    Contains("it is an HTML page, though the format that was given is obj"));
  CHECK_THROWS_WITH(parsed_text("OFF\n1 0 0\nx\n", MeshFormat::off), !Contains("though"));
}
