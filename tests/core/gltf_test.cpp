// glTF: exact tiny files. tests/corpus has damaged ones, tests/cli/test_gltf.py files of an independent
// writer.

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/corpus.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::Index;
using core::LoadedSoup;
using core::Point;

namespace {

LoadedSoup from_corpus(const std::string& name) {
  return core::read_polygon_soup(corpus_folder() + "/meshes/" + name);
}

const std::vector<Point> kTetrahedronPoints = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Index> kFaces = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

/// A JSON text around parts, with a square of four vertices in a buffer that `buffer` describes.
std::string square(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":5}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":48}],"buffers":[)" +
         buffer + "]}";
}

std::string square_bytes() {
  const std::array<float, 12> numbers = {0, 0, 0.1f, 1, 0, -0.0f, 0, 1, 0, 1, 1, 0};
  return {reinterpret_cast<const char*>(numbers.data()), sizeof numbers};
}

}  // namespace

TEST_CASE("binary and JSON glTF of a tetrahedron") {
  for (const char* name : {"tetrahedron.glb", "tetrahedron.gltf", "quantized.glb", "meshes_without_scene.glb",
                           "fraction_is_whole.gltf", "other_parts_damaged.glb"}) {
    INFO(name);
    const LoadedSoup loaded = from_corpus(name);
    CHECK(loaded.soup.positions == kTetrahedronPoints);
    CHECK(loaded.soup.corners == kFaces);
    CHECK(loaded.properties.empty());
    CHECK(loaded.warnings.empty());
  }
}

TEST_CASE("strips alternate and their stitches are left out; fans turn about their first corner") {
  const LoadedSoup strip = from_corpus("strip_gltf.gltf");
  CHECK(strip.soup.corners == std::vector<Index>{0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4});
  core::build_mesh(strip.soup).mesh.validate();
  CHECK(from_corpus("fan_gltf.gltf").soup.corners == std::vector<Index>{0, 1, 3, 0, 3, 2});
}

TEST_CASE("transforms of nodes are applied, and mirrored triangles turned round") {
  const LoadedSoup mirrored = from_corpus("nodes_mirrored.gltf");
  CHECK(mirrored.soup.positions == std::vector<Point>{{10, 0, 0}, {8, 0, 0}, {10, 1, 0}, {10, 0, 1}});
  CHECK(mirrored.soup.corners == std::vector<Index>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0});
  const LoadedSoup twice = from_corpus("nodes_matrix.gltf");
  REQUIRE(twice.soup.positions.size() == 8);
  CHECK(twice.soup.positions[0] == Point(5, 6, 7));
  CHECK(twice.soup.positions[1] == Point(5, 7, 7));
  CHECK(twice.soup.positions[2] == Point(4, 6, 7));
  CHECK(twice.soup.positions[5] == Point(1, 0, 0));
  CHECK(twice.soup.corners[12] == 4);
}

TEST_CASE("scalar attributes become properties, and sparse accessors replace elements") {
  const LoadedSoup values = from_corpus("values.glb");
  REQUIRE(values.properties.size() == 1);
  CHECK(values.properties[0].name == "_HEIGHT");
  CHECK(values.properties[0].values == std::vector<double>{1.5, -2, 3, 0.25});
  const LoadedSoup sparse = from_corpus("sparse.glb");
  CHECK(sparse.soup.positions[3] == Point(0, 0, 9));
  CHECK(sparse.soup.positions[2] == Point(0, 1, 0));
}

TEST_CASE("what is left out is said") {
  const LoadedSoup loaded = from_corpus("left_out.glb");
  CHECK(loaded.warnings ==
        std::vector<std::string>{
            "1 primitive is points or lines, and left out",
            "1 node is skinned: the mesh is read as it is without its skeleton, at the origin"});
  CHECK(from_corpus("text_after_end.glb").warnings.size() == 1);
}

TEST_CASE("buffers are read from files in the same folder only") {
  const Scratch scratch;
  std::ofstream(scratch / "a b.bin", std::ios::binary) << square_bytes() << "more";
  const std::string text = square(R"({"byteLength":48,"uri":"a%20b.bin"})");
  std::ofstream(scratch / "a.gltf") << text;
  const LoadedSoup loaded = core::read_polygon_soup(scratch / "a.gltf");
  REQUIRE(loaded.soup.positions.size() == 4);
  CHECK(loaded.soup.positions[0].z() == static_cast<double>(0.1f));
  CHECK(std::signbit(loaded.soup.positions[1].z()));
  CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2, 1, 3, 2});
  CHECK_THROWS_WITH(core::parse_polygon_soup(text, core::MeshFormat::gltf, "memory"),
                    Catch::Contains("not read from a folder"));
  std::filesystem::create_directory(scratch / "inner");
  std::ofstream(scratch / "inner/a.gltf") << square(R"({"byteLength":48,"uri":"../a b.bin"})");
  CHECK_THROWS_WITH(core::read_polygon_soup(scratch / "inner/a.gltf"),
                    Catch::Contains("only files in the same folder are read"));
  std::ofstream(scratch / "missing.gltf") << square(R"({"byteLength":48,"uri":"none.bin"})");
  CHECK_THROWS_WITH(core::read_polygon_soup(scratch / "missing.gltf"), Catch::Contains("none.bin"));
  std::ofstream(scratch / "short.gltf") << square(R"({"byteLength":53,"uri":"a%20b.bin"})");
  CHECK_THROWS_WITH(core::read_polygon_soup(scratch / "short.gltf"),
                    Catch::Contains("announces 53 bytes, and there are 52"));
}

TEST_CASE("the files of a mesh are known before it is read") {
  const Scratch scratch;
  using Paths = std::vector<std::filesystem::path>;
  const std::string buffers =
      R"({"byteLength":48,"uri":"b.bin"},{"byteLength":48,"uri":"a%20b.bin"},{"byteLength":4,"uri":"b.bin"},
         {"byteLength":3,"uri":"data:;base64,AAAA"},{"byteLength":3,"uri":"../up.bin"},{"byteLength":3},7)";
  const Paths both = {scratch / "a b.bin", scratch / "b.bin"};
  CHECK(core::companion_files(scratch.file("a.gltf", square(buffers))) == both);
  CHECK(core::companion_files(scratch.file("a.txt", square(buffers))).empty());
  CHECK(core::companion_files(scratch / "a.txt", core::MeshFormat::gltf) == both);
  CHECK(core::companion_files(scratch / "a.gltf", core::MeshFormat::off).empty());

  const auto word = [](std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&small), sizeof small);
  };
  const std::string json = square(buffers);
  const std::string binary =
      "glTF" + word(2) + word(20 + json.size() + 12) + word(json.size()) + "JSON" + json;
  CHECK(core::companion_files(scratch.file("a.glb", binary + word(4) + std::string("BIN\0data", 8))) == both);
  CHECK(core::companion_files(scratch.file("cut.glb", binary)) == both);
  // Bad files name none; reading says why.
  for (std::size_t length = 0; length < binary.size(); ++length)
    REQUIRE(core::companion_files(scratch.file("cut.glb", binary.substr(0, length))).empty());
  CHECK(core::companion_files(scratch.file("bad.gltf", R"({"buffers":{"uri":"b.bin"}})")).empty());
  CHECK(core::companion_files(scratch.file("bad.gltf", "{")).empty());
  CHECK(core::companion_files(scratch / "none.gltf").empty());
  CHECK(core::companion_files(scratch.path()).empty());
}

TEST_CASE("custom properties are left out, whatever they hold") {
  for (const char* name : {"extras_mode.gltf", "extras_underscore.gltf", "extras_of_material.gltf"}) {
    INFO(name);
    CHECK(from_corpus(name).soup.corners == kFaces);
  }
  // What follows is checked again.
  const std::string text = square(R"({"extras":{"a":[{"count":"x"}]},"byteLength":"48"})");
  CHECK_THROWS_WITH(core::parse_polygon_soup(text, core::MeshFormat::gltf, "test"),
                    Catch::Contains("\"byteLength\", which should be a whole number"));
}

TEST_CASE("primitives of a node that share their accessors share the vertices") {
  const std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1},
                             {"attributes":{"POSITION":0},"indices":2}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                 {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"},
                 {"bufferView":1,"byteOffset":3,"componentType":5121,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":1,"byteLength":6}],
    "buffers":[{"byteLength":48,
                "uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA"},
               {"byteLength":6,"uri":"data:;base64,AAECAQMC"}]})";
  const LoadedSoup loaded = core::parse_polygon_soup(text, core::MeshFormat::gltf, "test");
  CHECK(loaded.soup.positions.size() == 8);
  CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6});
}

TEST_CASE("meshes that are repeated without end are refused") {
  std::string nodes, roots;
  for (int i = 0; i < 3000; ++i) {
    nodes += i == 0 ? R"({"mesh":0})" : R"(,{"mesh":0})";
    roots += (i == 0 ? "" : ",") + std::to_string(i);
  }
  const std::string data(static_cast<std::size_t>(4 * 12000), 'A');  // 36,000 zeros: 3,000 vertices
  const std::string text = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" +
                           nodes +
                           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3000,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36000}],
    "buffers":[{"byteLength":36000,"uri":"data:application/octet-stream;base64,)" +
                           data + R"("}]})";
  CHECK_THROWS_WITH(core::parse_polygon_soup(text, core::MeshFormat::gltf, "test"),
                    Catch::Contains("repeats its meshes so often"));
}
