#include "morsel/core/io/file_content.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "morsel/core/error.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/io/molecule.h"
#include "support/corpus.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;

namespace {

std::string gzipped(const std::string& text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  std::string copy = text;
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

const std::string kTetrahedron =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

std::string unpacked(const std::string& bytes) {
  return std::string(core::DecodedBytes(bytes, "test").view());
}

}  // namespace

TEST_CASE("gzip, xz and zstd data become what they hold, member after member") {
  std::map<std::string, std::string> files;
  for (const CorpusFile& file : corpus("compressed", 15)) files[file.name] = file.bytes;
  for (const char* name :
       {"gzip", "xz", "zstd", "gzip_members", "xz_streams", "zstd_frames", "gzip_padded", "zstd_skippable"}) {
    INFO(name);
    CHECK(unpacked(files.at(name)) == kTetrahedron);
  }
  CHECK(unpacked(files.at("plain")) == files.at("plain"));
  for (const auto& [name, sentence] : std::map<std::string, std::string>{
           {"gzip_wrong_checksum", "cannot read \"test\": its gzip data are damaged: incorrect data check"},
           {"gzip_wrong_length", "incorrect length check"},
           {"xz_damaged", "its xz data are damaged"},
           {"zstd_wrong_checksum", "its zstd data are damaged"},
           {"gzip_truncated", "its gzip data are truncated"},
           {"xz_truncated", "its xz data are truncated"},
           {"zstd_truncated", "its zstd data are truncated"},
           {"gzip_and_text", "end before its last 4 bytes, which are something else"},
           {"gzip_then_damaged_member", "its gzip data are damaged"}}) {
    INFO(name);
    CHECK_THROWS_WITH(unpacked(files.at(name)), Contains(sentence));
    CHECK_THROWS_AS(unpacked(files.at(name)), core::BadInput);
  }
  for (const char* name : {"gzip_bomb", "xz_bomb", "zstd_bomb"}) {
    INFO(name);
    const std::string& bytes = files.at(name);
    const core::Compression kind = core::compression_of(bytes);
    CHECK(unpacked(bytes) == std::string(std::size_t{4} << 20, '\0'));
    CHECK_THROWS_WITH(core::decompress(bytes, kind, "test", {}, {.least = std::size_t{3} << 20, .ratio = 4}),
                      Contains("expand to more than 3 MiB") && Contains("which is refused"));
  }
}

TEST_CASE("compressed data cut off anywhere are refused") {
  for (const char* name : {"gzip", "xz", "zstd"})
    for (const CorpusFile& file : corpus("compressed")) {
      if (file.name != name) continue;
      for (std::size_t length = 6; length < file.bytes.size(); ++length) {
        INFO(name << ", " << length);
        CHECK_THROWS_WITH(unpacked(file.bytes.substr(0, length)), Contains("data are truncated"));
      }
    }
}

TEST_CASE("decompression of much can be stopped and gives all of it") {
  std::string text;
  while (text.size() < (std::size_t{5} << 20)) text += std::to_string(text.size() * 7919 % 100003) + "\n";
  const std::string packed = gzipped(text);
  CHECK(unpacked(packed) == text);
  std::stop_source stop;
  int reports = 0;
  const core::Progress progress(
      [&](std::string_view step, double fraction) {
        CHECK(step == "decompressing");
        CHECK((fraction >= 0 && fraction <= 1));
        if (++reports == 3) stop.request_stop();
      },
      stop.get_token());
  CHECK_THROWS_AS(core::DecodedBytes(packed, "test", progress), core::Cancelled);
  CHECK(reports == 3);
}

TEST_CASE("the extension below that of a compression says what a file holds") {
  CHECK(core::content_extension("a/b.OFF.gz") == ".off");
  CHECK(core::content_extension("b.obj.XZ") == ".obj");
  CHECK(core::content_extension("b.ply.Zst") == ".ply");
  CHECK(core::content_extension("b.gz").empty());
  CHECK(core::content_extension("b.off") == ".off");
  CHECK(core::content_extension("b.off.gz.gz") == ".gz");
  CHECK(core::has_mesh_extension("lion.Off.GZ"));
  CHECK_FALSE(core::has_mesh_extension("lion.txt.gz"));
  CHECK_FALSE(core::has_mesh_extension("off.gz"));
  CHECK(core::mesh_format("x.stl.zst") == core::MeshFormat::stl);
}

TEST_CASE("a compressed mesh is the mesh, by its name or by its content") {
  const Scratch scratch;
  for (const char* name : {"a.off.gz", "b.OFF.GZ", "c.off"}) {
    const core::LoadedSoup soup = core::read_polygon_soup(scratch.file(name, gzipped(kTetrahedron)));
    CHECK(soup.soup.positions.size() == 4);
    CHECK(soup.soup.polygon_count() == 4);
    CHECK(soup.warnings.empty());
  }
  const auto as_obj = [&](const char* name) {
    return core::read_polygon_soup(scratch.file(name, gzipped(kTetrahedron)));
  };
  CHECK_THROWS_WITH(as_obj("a.obj.gz"), Contains("it is an OFF file, though read as .obj") &&
                                            Contains(": name it .off or use --format off"));
  CHECK_THROWS_WITH(as_obj("a.txt"),
                    Contains("files, not .txt; it is an OFF file: name it .off or use --format off"));
}

TEST_CASE("a compressed surface of FreeSurfer is known by its content") {
  const Scratch scratch;
  for (const CorpusFile& file : mesh_corpus()) {
    if (file.name != "freesurfer_by_content.bin") continue;
    const auto path = scratch.file("fsb.bin.gz", gzipped(file.bytes));
    CHECK(core::recognised_format(path) == core::MeshFormat::freesurfer);
    CHECK(core::read_polygon_soup(path).soup.corners == core::read_polygon_soup(file.path).soup.corners);
  }
  CHECK(core::recognised_format(scratch.file("text.gz", gzipped("text"))) == std::nullopt);
}

namespace {

std::string in_base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[group >> shift & 63];
  }
  if (bytes.size() % 3 > 0)
    std::fill(text.end() - (3 - static_cast<std::ptrdiff_t>(bytes.size() % 3)), text.end(), '=');
  return text;
}

/// The header and the start of compressed data of VTK: `blocks` blocks of `size` bytes, the data cut off.
std::string vtk_block(std::uint32_t blocks, std::uint32_t size) {
  std::string bytes(12 + 4 * std::size_t{blocks}, '\0');
  const std::array<std::uint32_t, 3> head = {blocks, size, 0};
  std::memcpy(bytes.data(), head.data(), sizeof head);
  return in_base64(bytes);
}

std::string vtp_refusal(const std::string& points, const std::string& array, const std::string& more = "") {
  const std::string file =
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
      "compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"" +
      points + "\"><PointData>" + array + "</PointData><Points>" + more +
      "</Points></Piece></PolyData></VTKFile>";
  try {
    core::parse_polygon_soup(file, core::MeshFormat::vtp, "bomb.vtp");
  } catch (const core::BadInput& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("a VTP file whose arrays expand to more than is announced, or than is allowed, is refused") {
  const std::string points =
      "<DataArray type=\"UInt8\" NumberOfComponents=\"3\">0 0 0 1 0 0 0 1 0</DataArray>";
  const auto array = [](std::uint32_t blocks, std::uint32_t size) {
    return "<DataArray type=\"UInt8\" Name=\"a\" format=\"binary\">" + vtk_block(blocks, size) +
           "</DataArray>";
  };
  CHECK(vtp_refusal("3", array(1, 400'000'000), points) ==
        "cannot read \"bomb.vtp\": the array \"a\" of its points is said to have 400000000 bytes, but 3 "
        "numbers "
        "of 1 are announced");
  // 16 million points are 48 million numbers, of one byte in the file and eight in memory.
  CHECK_THAT(
      vtp_refusal("16000000", "",
                  "<DataArray type=\"UInt8\" format=\"binary\">" + vtk_block(1, 48'000'000) + "</DataArray>"),
      Contains("expand to more than 256 MiB") && Contains("at the array of points") &&
          Contains("which is refused"));
  CHECK_THAT(vtp_refusal("3", "",
                         "<DataArray type=\"UInt8\" format=\"binary\">" + vtk_block(200, 0xFFFF'FFFF) +
                             "</DataArray>"),
             Contains("is said to have 858993459000 bytes, but 9 numbers"));
}

TEST_CASE("what a file's compressed parts become in memory is counted together") {
  core::DecompressionBudget budget(1000, {.least = 4096, .ratio = 2});
  budget.take(256, 8, "a", "the first");
  budget.take(2048, 1, "a", "the second");
  CHECK_THROWS_WITH(
      budget.take(1, 1, "a", "the third"),
      "cannot read \"a\": its data expand to more than 0 MiB, over 4 times its size, at the third, "
      "which is refused: write it without compression if that is meant");
  CHECK_THROWS_AS(budget.take(std::uint64_t{1} << 62, 8, "a", "an overflow"), core::BadInput);
}

TEST_CASE("a GIFTI file whose arrays expand to more than is allowed is refused") {
  const auto array = [](const std::string& intent, std::size_t rows, const std::string& data) {
    return "<DataArray Intent=\"NIFTI_INTENT_" + intent +
           "\" DataType=\"NIFTI_TYPE_UINT8\" Dimensionality=\"2\" "
           "Dim0=\"" +
           std::to_string(rows) +
           "\" Dim1=\"3\" Encoding=\"GZipBase64Binary\" "
           "Endian=\"LittleEndian\"><Data>" +
           data + "</Data></DataArray>";
  };
  const auto refusal = [&](std::size_t rows, const std::string& data) -> std::string {
    try {
      core::parse_polygon_soup(
          "<GIFTI>" + array("POINTSET", rows, data) + array("TRIANGLE", 1, data) + "</GIFTI>",
          core::MeshFormat::gifti, "bomb.gii");
    } catch (const core::BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  CHECK_THAT(refusal(12'000'000, in_base64(gzipped("short"))),
             Contains("expand to more than 256 MiB") && Contains("at data array 1 (NIFTI_INTENT_POINTSET)"));
  CHECK_THAT(refusal(1, in_base64(gzipped(std::string(5'000'000, '\0')))),
             Contains("it has more than the 3 bytes that its sizes need"));
}

TEST_CASE("a number too small for its type is 0 in GIFTI as in other files") {
  const core::LoadedSoup loaded = core::parse_polygon_soup(
      "<GIFTI><DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32\" "
      "Dimensionality=\"2\" "
      "Dim0=\"3\" Dim1=\"3\" Encoding=\"ASCII\"><Data>1e-60 -1e-60 0 1 0 0 0 +1 0</Data></DataArray>"
      "<DataArray Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" Dimensionality=\"2\" "
      "Dim0=\"1\" Dim1=\"3\" Encoding=\"ASCII\"><Data>0 1 2</Data></DataArray></GIFTI>",
      core::MeshFormat::gifti, "tiny.gii");
  CHECK(loaded.soup.positions[0] == core::Point(0, 0, 0));
  CHECK(std::signbit(loaded.soup.positions[0].y()));
}

TEST_CASE("UTF-16 text is converted") {
  using namespace std::string_literals;
  CHECK(core::utf8_of_utf16("\xFF\xFE"s + "a\0"s + "\xE9\0"s + "\xAC\x20"s + "\x3D\xD8\x00\xDE"s, "test") ==
        "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
  CHECK(core::utf8_of_utf16("\xFE\xFF"s + "\0a"s + "\x20\xAC"s, "test") == "a\xE2\x82\xAC");
  for (const std::string& wrong : {"\xFF\xFE"s + "a"s, "\xFF\xFE"s + "\x00\xDC"s, "\xFF\xFE"s + "\x00\xD8"s,
                                   "\xFF\xFE"s + "\x00\xD8"s + "a\0"s})
    CHECK_THROWS_AS(core::utf8_of_utf16(wrong, "test"), core::BadInput);
  CHECK(core::is_utf16("\xFF\xFEO\0"s));
  CHECK(core::is_utf16("\xFE\xFF\0\n"s));
  CHECK_FALSE(core::is_utf16("\xFF\xFE  "s));  // a header of a binary file
  CHECK_FALSE(core::is_utf16("\xFF\xFEO"s));
}

TEST_CASE("text comes without a byte-order mark and with lines") {
  using namespace std::string_literals;
  const Scratch scratch;
  const auto text = [&](const std::string& bytes) {
    return std::string(core::TextContent(scratch.file("a.txt", bytes), "a.txt").view());
  };
  CHECK(text("a\nb\r\n") == "a\nb\r\n");
  CHECK(text("\xEF\xBB\xBF"
             "a\n") == "a\n");
  CHECK(text("a\rb\r") == "a\nb\n");
  CHECK(text(gzipped("\xFF\xFE"s + "a\0\r\0b\0"s)) == "a\nb");
  const core::TextContent content(scratch.file("b.txt", "\xFE\xFF\0a"s), "b.txt");
  CHECK(content.warnings() == std::vector<std::string>{core::kUtf16Warning});
}

TEST_CASE("files are named for what they are") {
  using namespace std::string_literals;
  for (const auto& [bytes, kind] : std::vector<std::pair<std::string, std::string>>{
           {"\x1F\x8B\x08"s, "gzip data"},
           {"BZh91AY", "bzip2 data"},
           {"PK\x03\x04", "a ZIP archive"},
           {"%PDF-1.4", "a PDF document"},
           {"\x89PNG\r\n\x1A\n", "a PNG picture"},
           {"<!doctype HTML><p>", "an HTML page"},
           {"  <html lang=\"en\">", "an HTML page"},
           {"<?xml version=\"1.0\"?>\n<!-- x --><VTKFile type=\"PolyData\">", "a VTK XML file"},
           {"<?xml version=\"1.0\"?><a/>", "XML"},
           {"{\"a\": 1}", "JSON"},
           {"[1, 2]", "JSON"},
           {"# made by hand\n\nv 0 0 0\n", "an OBJ file"},
           {"mtllib a.mtl\n", "an OBJ file"},
           {"OFF\n4 4 6\n", "an OFF file"},
           {"STCNOFF 1 2 3", "an OFF file"},
           {"ply\r\nformat", "a PLY file"},
           {"solid a\n facet normal", "an ASCII STL file"},
           {"data_1ABC\n", "a CIF file"},
           {"ATOM      1  N   ALA A   1", "a PDB file"},
           {"\xFF\xFEO\0F\0F\0"s, "UTF-16 text"},
           {"O\0F\0F\0\n\0"s, "UTF-16 text without a byte-order mark"},
           {"\0O\0F\0F\0\n"s, "UTF-16 text without a byte-order mark"},
           {"", ""},
           {"hello\n", ""},
           {"0.5\n1e-3\n", ""},
           {"[A] note", ""}}) {
    INFO(bytes);
    CHECK(core::file_kind(bytes) == kind);
  }
}
