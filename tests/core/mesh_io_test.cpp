#include "morsel/core/io/mesh_io.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <locale>
#include <stop_token>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/io/mesh_writer.h"
#include "morsel/core/text/parameters.h"
#include "support/corpus.h"
#include "support/fields.h"
#include "support/meshes.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::LoadedMesh;
using core::LoadedSoup;
using core::MeshFormat;

namespace {

LoadedSoup parsed(const std::string& text, MeshFormat format) {
  return core::parse_polygon_soup(text, format, "test");
}

const std::vector<double>& property(const std::vector<core::VertexProperty>& properties,
                                    const std::string& name) {
  for (const auto& p : properties)
    if (p.name == name) return p.values;
  throw std::runtime_error("no property " + name);
}

bool same_bits(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b);
}

void check_same(const core::TriangleMesh& a, const core::TriangleMesh& b) {
  REQUIRE(a.vertex_count() == b.vertex_count());
  CHECK(std::equal(a.triangles().begin(), a.triangles().end(), b.triangles().begin(), b.triangles().end()));
  bool same = true;
  for (Index v = 0; v < a.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis) same = same && same_bits(a.position(v)[axis], b.position(v)[axis]);
  CHECK(same);
}

}  // namespace

TEST_CASE("coordinates are read to the last bit") {
  const std::vector<Point> expected = {
      {0.1, -0.0, 1.0 / 3}, {5e-324, 1e300, 123456789.123456789}, {1.5, -0.5, 0}};
  for (const auto& [format, text] : std::vector<std::pair<MeshFormat, std::string>>{
           {MeshFormat::off,
            "OFF\n3 1 0\n0.1 -0 0.33333333333333331\n5e-324 1e+300 123456789.123456789\n+1.5 -.5 1e-999\n3 0 "
            "1 2\n"},
           {MeshFormat::obj,
            "v 0.1 -0 0.33333333333333331\nv 5e-324 1e+300 123456789.123456789\nv +1.5 -.5 1e-999\nf 1 2 "
            "3\n"},
           {MeshFormat::ply,
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double "
            "z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0.1 -0 0.33333333333333331\n5e-324 1e+300 123456789.123456789\n+1.5 -.5 1e-999\n3 0 1 2\n"}}) {
    const LoadedSoup loaded = parsed(text, format);
    REQUIRE(loaded.soup.positions.size() == 3);
    for (std::size_t v = 0; v < 3; ++v)
      for (int axis = 0; axis < 3; ++axis)
        CHECK(same_bits(loaded.soup.positions[v][axis], expected[v][axis]));
    CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2});
  }
}

TEST_CASE("every scalar property of a PLY file is kept in its order") {
  for (const CorpusFile& file : mesh_corpus()) {
    if (file.name == "quality.ply") {
      const LoadedMesh loaded = core::read_mesh(file.path);
      REQUIRE(loaded.source.properties.size() == 4);  // the last one is of the faces
      CHECK(loaded.source.properties[0].name == "quality");
      // Declared as float: the nearest single-precision number, as the binary form would have it.
      CHECK(property(loaded.source.properties, "quality") == std::vector<double>{0.1f, 0.2f, 0.3f, 0.4f});
      CHECK(property(loaded.source.properties, "red") == std::vector<double>{255, 0, 7, 8});
      const auto& time = property(loaded.source.properties, "time");
      CHECK(time[0] == 1e-3);
      CHECK(std::isnan(time[1]));
      CHECK(time[2] == INFINITY);
      CHECK(loaded.mesh.position(3) == Point(0, 0, 1));
    }
    if (file.name.starts_with("binary_little") || file.name.starts_with("binary_big") ||
        file.name == "binary_crlf_header.ply" || file.name == "binary_cr_header.ply") {
      const LoadedMesh loaded = core::read_mesh(file.path);
      CHECK(property(loaded.source.properties, "level") == std::vector<double>{-2, -1, 0, 1});
      CHECK(property(loaded.source.properties, "red") == std::vector<double>{0, 80, 160, 240});
      CHECK(loaded.mesh.position(1) == Point(1, 0, 0));
    }
  }
}

TEST_CASE("polygons come out as the file has them") {
  const LoadedSoup loaded =
      parsed("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 1\nf\nf -4 -3 -2\n", MeshFormat::obj);
  CHECK(loaded.soup.offsets == std::vector<std::size_t>{0, 4, 6, 6, 9});
  CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2, 3, 3, 0, 0, 1, 2});
}

TEST_CASE("equal positions in an STL file are one vertex numbered by its first appearance") {
  std::string text = "solid\n";
  for (const char* facet : {"0 0 0 1 0 0 0 1 0", "0 1 0 1 0 0 1 1 1e-300"}) {
    double p[9];
    std::sscanf(facet, "%lf %lf %lf %lf %lf %lf %lf %lf %lf", p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6,
                p + 7, p + 8);
    text += "facet normal 0 0 1\nouter loop\n";
    for (int i = 0; i < 3; ++i) {
      text += "vertex";
      for (int axis = 0; axis < 3; ++axis) text += " " + core::shortest(p[3 * i + axis]);
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  const LoadedSoup loaded = parsed(text + "endsolid\n", MeshFormat::stl);
  CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2, 2, 1, 3});
  CHECK(loaded.soup.positions == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}});
}

TEST_CASE("welding many positions finds them all again") {
  // Enough for the table to grow several times; binary, in single precision.
  const Soup soup = sphere(4);
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& t : soup.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0f);
    for (const Index v : t)
      for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(soup.positions[v][axis]));
    append(std::uint16_t{0});
  }
  const LoadedSoup loaded = parsed(bytes, MeshFormat::stl);
  CHECK(loaded.soup.positions.size() == soup.positions.size());
  const core::TriangleMesh mesh = core::build_mesh(loaded.soup).mesh;
  CHECK(mesh.is_closed());
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      CHECK(mesh.position(mesh.triangle(t)[i]) ==
            soup.positions[soup.triangles[t][i]].cast<float>().cast<double>());
}

TEST_CASE("a file that is not there or not a mesh is refused by name") {
  const Scratch scratch;
  const auto read = [](const std::filesystem::path& path) { return core::read_mesh(path); };
  CHECK_THROWS_WITH(read(scratch / "a.off"), Catch::Contains("a.off") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(read(scratch / "a.xyz"), Catch::Contains("No such file"));
  CHECK_THROWS_WITH(read(scratch.path()), Catch::Contains("it is a directory"));
  CHECK_THROWS_WITH(read("/dev/null"), Catch::Contains("not a regular file"));
  CHECK_THROWS_WITH(read(scratch.file("a.step", "x")),
                    Catch::Contains(".off, .obj, .ply, .stl, .gltf, .glb, .vtk, .vtp, .vtu, .gii, "
                                    "FreeSurfer's lh.pial, .asc, .tif and .tiff files, not .step"));
  CHECK_THROWS_WITH(read(scratch.file("mesh", "x")), Catch::Contains("no extension"));
  CHECK_THROWS_AS(read(""), core::BadInput);
}

TEST_CASE("extensions are known in any case") {
  CHECK(core::mesh_format("a/b.OFF") == MeshFormat::off);
  CHECK(core::mesh_format("b.c.Obj") == MeshFormat::obj);
  CHECK(core::mesh_format("b.pLy") == MeshFormat::ply);
  CHECK(core::mesh_format("b.STL") == MeshFormat::stl);
}

TEST_CASE("numbers are read the same in any locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_ALL, name);
  const LoadedSoup loaded = parsed("OFF\n3 1 0\n0.5 1234.5 0\n1 0 0\n0 1 0\n3 0 1 2\n", MeshFormat::off);
  const Scratch scratch;
  const core::TriangleMesh mesh = core::build_mesh(loaded.soup).mesh;
  core::write_off(scratch / "a.off", mesh);
  std::locale::global(old);
  std::setlocale(LC_ALL, before.c_str());
  CHECK(loaded.soup.positions[0] == Point(0.5, 1234.5, 0));
  CHECK(contents(scratch / "a.off") == "OFF\n3 1 0\n0.5 1234.5 0\n1 0 0\n0 1 0\n3 0 1 2\n");
}

TEST_CASE("reading reports progress and can be stopped") {
  const Scratch scratch;
  const auto path = scratch / "large.off";
  core::write_off(path, grid(250, 250).mesh());
  std::vector<double> fractions;
  const core::Progress progress([&](std::string_view step, double fraction) {
    if (step == "reading the mesh") fractions.push_back(fraction);
    CHECK((fraction >= 0 && fraction <= 1));
  });
  core::read_mesh(path, {}, progress);
  CHECK(fractions.size() >= 3);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  for (const std::size_t calls : {2u, 4u}) {
    std::stop_source stop;
    std::size_t seen = 0;
    const core::Progress stopping(
        [&](std::string_view, double) {
          if (++seen == calls) stop.request_stop();
        },
        stop.get_token());
    CHECK_THROWS_AS(core::read_mesh(path, {}, stopping), core::Cancelled);
  }
}

TEST_CASE("a written mesh is read back bit for bit") {
  const Scratch scratch;
  for (const NamedMesh& entry : mesh_zoo()) {
    INFO(entry.name);
    core::write_off(scratch / "a.off", entry.mesh);
    check_same(core::read_mesh(scratch / "a.off").mesh, entry.mesh);
    std::vector<core::VertexProperty> properties = {{"height", random_values(entry.mesh.vertex_count(), 1)},
                                                    {"odd", random_values(entry.mesh.vertex_count(), 2)}};
    properties[1].values.front() = NAN;
    properties[1].values.back() = -INFINITY;
    core::write_ply(scratch / "a.ply", entry.mesh, properties);
    const LoadedMesh back = core::read_mesh(scratch / "a.ply");
    check_same(back.mesh, entry.mesh);
    REQUIRE(back.source.properties.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(back.source.properties[i].name == properties[i].name);
      CHECK(std::equal(properties[i].values.begin(), properties[i].values.end(),
                       back.source.properties[i].values.begin(), same_bits));
    }
  }
}

TEST_CASE("extreme coordinates survive writing and reading") {
  const core::TriangleMesh mesh(
      {{5e-324, -0.0, 1e-17}, {1e153, 0.1, -1e-300}, {-1e153, 1.0 / 3, 2.2250738585072014e-308}},
      {{0, 1, 2}});
  const Scratch scratch;
  core::write_off(scratch / "a.off", mesh);
  core::write_ply(scratch / "a.ply", mesh);
  check_same(core::read_mesh(scratch / "a.off").mesh, mesh);
  check_same(core::read_mesh(scratch / "a.ply").mesh, mesh);
}

TEST_CASE("whole numbers at vertices and faces are written as such, and the file is read") {
  const Scratch scratch;
  const core::TriangleMesh mesh = square_pair().mesh();
  const std::vector<std::int32_t> at_vertices = {7, -1, 2147483647, 0};
  const std::vector<double> heights = {0.1, 0.2, 0.3, 0.4};
  const std::vector<std::int32_t> at_faces = {5, -6};
  const std::vector<double> areas = {0.5, 0.25};
  const std::vector<std::uint8_t> reds = {0, 1, 128, 255};
  const std::vector<core::PropertyView> of_vertices = {
      {"segment", at_vertices}, {"height", heights}, {"red", reds}};
  const std::vector<core::PropertyView> of_faces = {{"segment", at_faces}, {"x", areas}};
  core::write_ply(scratch / "a.ply", mesh.positions(), mesh.triangles(), of_vertices, of_faces);
  const std::string bytes = contents(scratch / "a.ply");
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  CHECK(
      bytes.substr(0, body) ==
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nproperty int segment\nproperty double height\nproperty uchar red\nelement face 2\n"
      "property list uchar uint vertex_indices\nproperty int segment\nproperty double x\nend_header\n");
  REQUIRE(bytes.size() == body + 4 * (3 * 8 + 4 + 8 + 1) + 2 * (1 + 3 * 4 + 4 + 8));
  CHECK(bytes.substr(body + 4 * 37 + 13, 4) == std::string("\5\0\0\0", 4));
  CHECK(bytes.substr(body + 4 * 37 + 25 + 13, 4) == std::string("\xfa\xff\xff\xff", 4));
  const LoadedMesh back = core::read_mesh(scratch / "a.ply");
  check_same(back.mesh, mesh);
  CHECK(property(back.source.properties, "segment") == std::vector<double>{7, -1, 2147483647, 0});
  CHECK(property(back.source.properties, "height") == heights);
  CHECK(property(back.source.properties, "red") == std::vector<double>{0, 1, 128, 255});
}

TEST_CASE("properties that a PLY file cannot hold are refused before anything is written") {
  const Scratch scratch;
  const core::TriangleMesh mesh = single_triangle().mesh();
  const auto write = [&](const std::vector<core::VertexProperty>& properties) {
    core::write_ply(scratch / "a.ply", mesh, properties);
  };
  CHECK_THROWS_AS(write({{"two words", {1, 2, 3}}}), core::InvalidArgument);
  CHECK_THROWS_AS(write({{"", {1, 2, 3}}}), core::InvalidArgument);
  CHECK_THROWS_AS(write({{"x", {1, 2, 3}}}), core::InvalidArgument);
  CHECK_THROWS_AS(write({{"a", {1, 2, 3}}, {"a", {1, 2, 3}}}), core::InvalidArgument);
  CHECK_THROWS_AS(write({{"a", {1, 2}}}), core::InvalidArgument);
  const auto write_faces = [&](const std::string& name, const std::vector<std::int32_t>& values) {
    const core::PropertyView view(name, values);
    core::write_ply(scratch / "a.ply", mesh.positions(), mesh.triangles(), {}, {&view, 1});
  };
  CHECK_THROWS_AS(write_faces("vertex_indices", {1}), core::InvalidArgument);
  CHECK_THROWS_AS(write_faces("a", {1, 2}), core::InvalidArgument);
  CHECK(std::filesystem::is_empty(scratch.path()));
  CHECK_THROWS_AS(core::write_off(scratch.file("no") / "a.off", mesh), core::WriteFailed);
}

TEST_CASE("quads written as OBJ read back to the same bits") {
  const Scratch scratch;
  const std::vector<Point> positions = {{0, 0, 0.1},     {1, 0, 1e-300}, {1, 1, -2.5},
                                        {0, 1, 1.0 / 3}, {2, 0, 0},      {2, 1, 1e21}};
  const std::vector<std::array<Index, 4>> quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  core::write_obj(scratch / "a.obj", positions, quads);
  const LoadedSoup loaded = core::read_polygon_soup(scratch / "a.obj");
  CHECK(loaded.soup.positions == positions);
  CHECK(loaded.soup.offsets == std::vector<std::size_t>{0, 4, 8});
  CHECK(loaded.soup.corners == std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 2});
  CHECK_THROWS_AS(core::write_obj(scratch.file("no") / "a.obj", positions, quads), core::WriteFailed);
}

TEST_CASE("comments are at a file's head and readers skip them") {
  const Scratch scratch;
  const core::TriangleMesh mesh = single_triangle().mesh();
  const std::vector<std::string> comments = {"{\"a\": 1,", "end_header of \xc3\xa9l\xc3\xa9ments # 3 0 1 2"};
  core::write_off(scratch / "a.off", mesh, comments);
  core::write_ply(scratch / "a.ply", mesh, {}, comments);
  core::write_obj(scratch / "a.obj", mesh.positions(), std::vector<std::array<Index, 4>>{}, comments);
  CHECK(
      contents(scratch / "a.off").starts_with("OFF\n# " + comments[0] + "\n# " + comments[1] + "\n3 1 0\n"));
  CHECK(contents(scratch / "a.ply")
            .starts_with("ply\nformat binary_little_endian 1.0\ncomment " + comments[0] + "\ncomment " +
                         comments[1] + "\nelement vertex 3\n"));
  CHECK(contents(scratch / "a.obj").starts_with("# " + comments[0] + "\n# " + comments[1] + "\nv "));
  check_same(core::read_mesh(scratch / "a.off").mesh, mesh);
  check_same(core::read_mesh(scratch / "a.ply").mesh, mesh);
  CHECK(core::read_polygon_soup(scratch / "a.obj").soup.positions.size() == 3);
  for (const std::string wrong : {"two\nlines", "two\rlines", "a\tb", "it goes on \\", "\x7f"}) {
    CHECK_THROWS_AS(core::write_off(scratch / "b.off", mesh, {&wrong, 1}), core::InvalidArgument);
    CHECK_THROWS_AS(core::write_ply(scratch / "b.ply", mesh, {}, {&wrong, 1}), core::InvalidArgument);
    CHECK_THROWS_AS(core::write_obj(scratch / "b.obj", mesh.positions(), {}, {&wrong, 1}),
                    core::InvalidArgument);
  }
  for (const char* name : {"b.off", "b.ply", "b.obj"}) CHECK_FALSE(std::filesystem::exists(scratch / name));
}

TEST_CASE("the extension of an output is one of those that are allowed, in small or capital letters") {
  CHECK(core::checked_extension("a/b.Ply", "a field is written", {".txt", ".ply"}) == ".ply");
  CHECK(core::checked_extension("b.TXT", "a field is written", {".txt", ".ply"}) == ".txt");
  CHECK_THROWS_WITH(core::checked_extension("b.pln", "a field is written", {".txt", ".ply", ".vtp"}),
                    "a field is written to .txt, .ply or .vtp, not to \"b.pln\"");
  CHECK_THROWS_AS(core::checked_extension("ply", "a mesh is written", {".ply"}), core::InvalidArgument);
  const core::FileTarget open = core::FileTarget::open_file(1, "standard output", ".label.gii");
  CHECK(core::checked_extension(open, "labels are written", {".ply", ".label.gii"}) == ".label.gii");
  CHECK_THROWS_AS(core::checked_extension(open, "labels are written", {".ply"}), core::InvalidArgument);
  CHECK_THROWS_AS(core::checked_extension("", "a mesh is written", {".ply"}), core::InvalidArgument);
}
