// FreeSurfer's and GIFTI's surfaces and values; tests/cli/test_brains.py compares them with nibabel.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/text/base64.h"
#include "support/corpus.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;

namespace {

core::LoadedSoup surface(const std::string& name) {
  return core::read_polygon_soup(corpus_folder() + "/meshes/" + name);
}

void check_same_soup(const core::PolygonSoup& a, const core::PolygonSoup& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.offsets == b.offsets);
  CHECK(a.corners == b.corners);
}

core::ValueFile value_file(const std::string& name, const std::string& column = {}) {
  return core::read_value_file(corpus_folder() + "/values/" + name, column);
}

/// The message of the refusal.
std::string refused(const std::string& name, const std::string& column = {}) {
  try {
    value_file(name, column);
  } catch (const core::BadInput& error) {
    CHECK(std::string(error.what()).find(name) != std::string::npos);
    return error.what();
  }
  FAIL(name << " is taken");
  return {};
}

}  // namespace

TEST_CASE("FreeSurfer's surface has the vertices and triangles of its file") {
  const core::LoadedSoup loaded = surface("lh.tetrahedron.pial");
  CHECK(loaded.soup.positions == std::vector<core::Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(loaded.soup.corners == std::vector<core::Index>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
  CHECK(loaded.soup.offsets == std::vector<std::size_t>{0, 3, 6, 9, 12});
  for (const char* name : {"lh.footer.pial", "lh.one_newline.pial", "freesurfer_by_content.bin"})
    check_same_soup(surface(name).soup, loaded.soup);
}

TEST_CASE("FreeSurfer's old surfaces have quads") {
  const core::PolygonSoup soup = surface("lh.quads.pial").soup;
  CHECK(soup.positions.size() == 8);
  CHECK(soup.positions[6] == core::Point(1, 1, 1));
  REQUIRE(soup.polygon_count() == 6);
  CHECK(std::vector<core::Index>(soup.corners.begin(), soup.corners.begin() + 8) ==
        std::vector<core::Index>{0, 3, 2, 1, 4, 5, 6, 7});
  check_same_soup(surface("lh.quads_of_floats.pial").soup, soup);
  CHECK(core::build_mesh(soup).mesh.triangle_count() == 12);
}

TEST_CASE("a GIFTI surface is the same in every encoding") {
  const core::PolygonSoup soup = surface("lh.tetrahedron.pial").soup;
  for (const char* name :
       {"ascii.gii", "base64.gii", "gzip.gii", "big_endian.gii", "column_major.gii", "wide_types.gii"}) {
    INFO(name);
    const core::LoadedSoup loaded = surface(name);
    check_same_soup(loaded.soup, soup);
    CHECK(loaded.warnings.empty());
    CHECK(loaded.properties.empty());
  }
}

TEST_CASE("a GIFTI surface has the values that are in its file") {
  const core::LoadedSoup loaded = surface("with_values.gii");
  REQUIRE(loaded.properties.size() == 2);
  CHECK(loaded.properties[0].name == "sulc");
  CHECK(loaded.properties[0].values == std::vector<double>{0.5, -1, 2, 3.25});
  CHECK(loaded.properties[1].name == "sulc (array 4)");
  REQUIRE(loaded.warnings.size() == 1);
  CHECK_THAT(loaded.warnings[0], Catch::Contains("data array 5") && Catch::Contains("3 values"));
  CHECK_THAT(surface("two_pointsets.gii").warnings.at(0), Catch::Contains("of which the first is read"));
}

TEST_CASE("FreeSurfer's surfaces go by their names") {
  for (const char* name :
       {"lh.white", "rh.pial", "lh.inflated", "rh.sphere.reg", "lh.orig.nofix", "a/b/lh.smoothwm",
        "lh.pial.T1", "lh.fsaverage.sphere.reg", "lh.pial-outer-smoothed", "lh.white.gz"}) {
    INFO(name);
    CHECK(core::has_mesh_extension(name));
    CHECK(core::mesh_format(name) == core::MeshFormat::freesurfer);
  }
  for (const char* name : {"lh.sulc", "lh.curv", "lh.curv.pial.x", "lh.white.H", "lh.aparc.annot", "white",
                           "pial.lh", "lh.whitening", "lh.reg", "LH.white"}) {
    INFO(name);
    CHECK_FALSE(core::has_mesh_extension(name));
  }
  CHECK(core::mesh_format("lh.white.off") == core::MeshFormat::off);
  for (const char* name : {"a.gii", "lh.pial.surf.gii", "A.GII"}) {
    CHECK(core::mesh_format(name) == core::MeshFormat::gifti);
    CHECK(core::has_mesh_extension(name));
  }
  // Values for the vertices of another file are not in a collection of meshes.
  for (const char* name : {"a.shape.gii", "a.func.gii", "a.Label.gii"}) {
    CHECK(core::mesh_format(name) == core::MeshFormat::gifti);
    CHECK_FALSE(core::has_mesh_extension(name));
  }
  const Scratch scratch;
  const auto path = scratch.file("anything", contents(corpus_folder() + "/meshes/lh.tetrahedron.pial"));
  CHECK(core::recognised_format(path) == core::MeshFormat::freesurfer);
  CHECK(core::recognised_format(scratch.file("b", "text")) == std::nullopt);
  CHECK(core::recognised_format(scratch / "absent") == std::nullopt);
}

TEST_CASE("FreeSurfer's values are read in both kinds") {
  const std::vector<double> expected = {0.5, -1, 2, 3.25};
  CHECK(value_file("lh.sulc").values == expected);
  CHECK(value_file("lh.old.curv").values == expected);
  CHECK(value_file("lh.sulc").place(2) == "entry 2");
  CHECK(value_file("lh.sulc", "1").values == expected);
  CHECK_THAT(refused("lh.sulc", "2"), Catch::Contains("column"));
  CHECK_THAT(refused("lh.cut.sulc"), Catch::Contains("4 values") && Catch::Contains("31 bytes"));
  CHECK_THAT(refused("lh.two.sulc"), Catch::Contains("2 values for each vertex"));
}

TEST_CASE("an annotation's labels are numbered as in its table") {
  CHECK(value_file("aparc.annot").values == std::vector<double>{0, 2, -1, 1});
  CHECK(value_file("old_table.annot").values == std::vector<double>{0, 2, -1, 1});
  CHECK_THAT(refused("no_table.annot"), Catch::Contains("no colour table"));
  CHECK_THAT(refused("cut.annot"), Catch::Contains("colour table"));
}

TEST_CASE("GIFTI values are chosen by name or number") {
  const std::vector<double> expected = {0.5, -1, 2, 3.25};
  const std::vector<double> other = {-0.5, 1, -2, -3.25};
  CHECK(value_file("one.shape.gii").values == expected);
  CHECK(value_file("one.shape.gii", "sulc").values == expected);
  CHECK(value_file("two.func.gii", "first").values == expected);
  CHECK(value_file("two.func.gii", "value").values == other);
  CHECK(value_file("two.func.gii", "2").values == other);
  CHECK(value_file("matrix.func.gii", "2").values == std::vector<double>{1, -2, 4, 6.5});
  CHECK(value_file("labels.label.gii").values == std::vector<double>{0, 2, -1, 1});
  CHECK_THAT(refused("two.func.gii"), Catch::Contains("2 columns") && Catch::Contains("\"first\""));
  CHECK_THAT(refused("two.func.gii", "third"), Catch::Contains("third"));
  CHECK_THAT(refused("matrix.func.gii", "3"), Catch::Contains("3"));
  CHECK_THAT(refused("nodes.func.gii"), Catch::Contains("every vertex"));
  CHECK_THAT(refused("surface.gii"), Catch::Contains("no values"));
}

TEST_CASE("values that are cut off anywhere are refused") {
  for (const char* name : {"lh.sulc", "aparc.annot", "old_table.annot", "one.shape.gii", "matrix.func.gii"}) {
    const std::string bytes = contents(corpus_folder() + "/values/" + name);
    const std::string file = std::string("damaged.") + name;
    // Without its mark it is a text, of no values.
    for (std::size_t length = name == std::string("lh.sulc") ? 3 : 0; length + 1 < bytes.size(); ++length) {
      INFO(name << " cut to " << length << " of " << bytes.size());
      CHECK_THROWS_AS(core::parse_value_file(bytes.substr(0, length), file, "1"), core::BadInput);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i)
      for (const char change : {'\0', '\x7F', '\xFF', '9', static_cast<char>(bytes[i] ^ 1)}) {
        std::string damaged = bytes;
        damaged[i] = change;
        try {
          core::parse_value_file(damaged, file, "1");
        } catch (const core::BadInput& error) {
          CHECK(std::string(error.what()).find("damaged") != std::string::npos);
        }
      }
  }
}

TEST_CASE("base64 is decoded as RFC 4648 has it") {
  using core::decode_base64;
  CHECK(decode_base64("") == "");
  CHECK(decode_base64("Zg==") == "f");
  CHECK(decode_base64("Zm8=") == "fo");
  CHECK(decode_base64("Zm9v") == "foo");
  CHECK(decode_base64(" Zm9v\nYmFy\t") == "foobar");
  CHECK(decode_base64("Zm8") == "fo");
  CHECK(decode_base64("+/+/") == "\xFB\xFF\xBF");
  CHECK_FALSE(decode_base64("Z"));
  CHECK_FALSE(decode_base64("Zg==Zg=="));
  CHECK_FALSE(decode_base64("Zm9-"));
  CHECK_FALSE(decode_base64("Zm9v\x80"));
}
