// Each format cut off and changed at each byte: a mesh or a BadInput, nothing else; and a truncated file
// must be refused.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/corpus.h"

using namespace morsel;
using namespace morsel::test;

namespace {

/// One whole file of each kind.
std::vector<CorpusFile> whole_files() {
  const std::set<std::string> names = {"tetrahedron.off",
                                       "coff.off",
                                       "stcnoff.off",
                                       "tetrahedron.obj",
                                       "attributes.obj",
                                       "relative.obj",
                                       "quality.ply",
                                       "other_elements.ply",
                                       "binary_little.ply",
                                       "binary_big.ply",
                                       "tetrahedron.stl",
                                       "binary.stl",
                                       "binary_solid_header.stl",
                                       "lh.tetrahedron.pial",
                                       "lh.quads.pial",
                                       "lh.quads_of_floats.pial",
                                       "ascii.gii",
                                       "gzip.gii",
                                       "with_values.gii",
                                       "ascii.vtk",
                                       "binary.vtk",
                                       "binary_5_1.vtk",
                                       "grid.vtk",
                                       "many_attributes.vtk",
                                       "ascii.vtp",
                                       "inline_zlib.vtp",
                                       "appended_raw.vtp",
                                       "appended_base64.vtp",
                                       "appended_raw_zlib_big.vtp",
                                       "grid_zlib.vtu",
                                       "numbers_on_any_lines.off",
                                       "vertices_on_any_lines_colored_faces.off",
                                       "coff_on_any_lines.off",
                                       "strip_restarts.ply",
                                       "binary_strips.ply",
                                       "faces_and_strip.ply",
                                       "longer_face_lines.ply",
                                       "whole_with_decimals.ply",
                                       "face_values.ply",
                                       "glued_backslash.obj",
                                       "gzip.off.gz",
                                       "xz.OFF.XZ",
                                       "zstd.ply.zst",
                                       "tetrahedron.gltf",
                                       "tetrahedron.glb",
                                       "values.glb",
                                       "sparse.glb",
                                       "terrain.asc",
                                       "terrain_upper_case_one_line.asc"};
  std::vector<CorpusFile> result;
  for (const CorpusFile& file : mesh_corpus())
    if (names.contains(file.name)) result.push_back(file);
  REQUIRE(result.size() == names.size());
  return result;
}

/// Whether what was cut off a file of VTK's legacy format is a whole section of it, as it does not say how
/// many there are; or the rest of an array's last line.
bool is_section(std::string_view rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \n"), rest.size()));
  for (const std::string_view keyword :
       {"POLYGONS", "POINT_DATA", "CELL_DATA", "SCALARS", "LOOKUP_TABLE mine 2", "FIELD", "NORMALS",
        "METADATA", "INFORMATION", "TEXTURE_COORDINATES", "COLOR_SCALARS"})
    if (rest.starts_with(keyword)) return true;
  return rest.empty();
}

/// Whether the bytes are taken for a file. Anything but BadInput is passed on and fails the test.
bool is_taken(const std::string& bytes, core::MeshFormat format) {
  try {
    const core::LoadedSoup loaded = core::parse_polygon_soup(bytes, format, "damaged");
    for (const bool repair : {false, true}) {
      try {
        core::build_mesh(loaded.soup, {.repair = repair}).mesh.validate();
      } catch (const core::BadInput&) {
      }
    }
    return true;
  } catch (const core::BadInput& error) {
    CHECK(std::string(error.what()).find("damaged") != std::string::npos);
    return false;
  }
}

}  // namespace

TEST_CASE("a file that is cut off is refused wherever that is") {
  for (const CorpusFile& file : whole_files()) {
    const core::MeshFormat format = core::mesh_format(file.name);
    for (std::size_t length = 0; length < file.bytes.size(); ++length) {
      const std::string cut = file.bytes.substr(0, length);
      const bool taken = is_taken(cut, format);
      if (format == core::MeshFormat::obj || !taken) continue;  // OBJ does not say how much is to come
      if (format == core::MeshFormat::vtk) {
        const std::size_t word_end = std::min(file.bytes.find_first_of(" \n", length), file.bytes.size());
        INFO(file.name << " cut to " << length << " of " << file.bytes.size() << " bytes");
        const std::size_t metadata = cut.rfind("METADATA");  // up to a blank line
        const bool is_metadata =
            metadata != std::string::npos && cut.find("\n\n", metadata) == std::string::npos;
        CHECK((is_metadata || is_section(file.bytes.substr(length)) ||
               is_section(file.bytes.substr(word_end))));
        continue;
      }
      // Only the last line's end may be missing, or digits of the last number, or of the name after endsolid.
      INFO(file.name << " cut to " << length << " of " << file.bytes.size() << " bytes");
      const bool is_named = format == core::MeshFormat::stl && cut.find("endsolid") != std::string::npos;
      CHECK((is_named || file.bytes.find_first_of(" \n", length) >= file.bytes.size() - 1));
    }
  }
}

TEST_CASE("a file with any byte changed gives a mesh or an error") {
  for (const CorpusFile& file : whole_files()) {
    const core::MeshFormat format = core::mesh_format(file.name);
    std::string bytes = file.bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const char original = bytes[i];
      for (const char change : {'\0', '\xFF', '\n', ' ', '-', '9', 'e', static_cast<char>(original ^ 1),
                                static_cast<char>(original ^ 0x80)}) {
        bytes[i] = change;
        INFO(file.name << ", byte " << i << " changed to " << static_cast<int>(change));
        REQUIRE_NOTHROW(is_taken(bytes, format));
      }
      bytes[i] = original;
    }
  }
}

TEST_CASE("a file with any byte removed or doubled gives a mesh or an error") {
  for (const CorpusFile& file : whole_files()) {
    const core::MeshFormat format = core::mesh_format(file.name);
    for (std::size_t i = 0; i < file.bytes.size(); ++i) {
      std::string shorter = file.bytes;
      shorter.erase(i, 1);
      std::string longer = file.bytes;
      longer.insert(i, 1, longer[i]);
      INFO(file.name << ", byte " << i);
      REQUIRE_NOTHROW(is_taken(shorter, format));
      REQUIRE_NOTHROW(is_taken(longer, format));
    }
  }
}
