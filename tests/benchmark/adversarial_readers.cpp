// Costly inputs for the readers and for the building of meshes.

#include <numeric>
#include <string_view>
#include <utility>

#include "benchmark/adversarial.h"
#include "morsel/core/io/atom_records.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/text/parameters.h"
#include "morsel/core/text/specification.h"
#include "support/adversarial.h"

namespace morsel::benchmark {
namespace {

using core::MeshFormat;
namespace adversarial = test::adversarial;

/// Reads a file of these bytes.
std::function<void()> reading(std::string bytes, MeshFormat format) {
  return [bytes = std::move(bytes), format] { core::parse_polygon_soup(bytes, format, "adversarial"); };
}

/// Makes a mesh of these triangles.
std::function<void()> building(const test::Soup& triangles, bool repair) {
  core::PolygonSoup soup;
  soup.positions = triangles.positions;
  for (const core::Triangle& t : triangles.triangles) soup.add_polygon(t);
  return [soup = std::move(soup), repair] { core::build_mesh(soup, {.repair = repair}); };
}

/// Makes a mesh of one polygon.
std::function<void()> cutting(std::vector<core::Point> corners) {
  core::PolygonSoup soup;
  soup.corners.resize(corners.size());
  std::iota(soup.corners.begin(), soup.corners.end(), core::Index{0});
  soup.offsets.push_back(corners.size());
  soup.positions = std::move(corners);
  return [soup = std::move(soup)] { core::build_mesh(soup); };
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

}  // namespace

std::vector<Family> reader_families() {
  using Size = std::size_t;
  std::vector<Family> families = {
      {"PLY header of many properties", 20'000,
       [](const Plan&, Size n) { return reading(adversarial::ply_with_properties(n), MeshFormat::ply); }},
      {"PLY header of many elements", 20'000,
       [](const Plan&, Size n) { return reading(adversarial::ply_with_elements(n), MeshFormat::ply); }},
      {"ASCII STL of colliding points", 15'000,
       [](const Plan&, Size n) {
         return reading(adversarial::ascii_stl(adversarial::colliding_points(n)), MeshFormat::stl);
       }},
      {"OBJ face in one long line", 400'000,
       [](const Plan&, Size n) { return reading("v 0 0 0\nf" + repeated(" 1", n), MeshFormat::obj); }},
      {"OBJ face of many continued lines", 400'000,
       [](const Plan&, Size n) { return reading("v 0 0 0\nf" + repeated(" 1 \\\n", n), MeshFormat::obj); }},
      {"OBJ backslashes within a line", 400'000,
       [](const Plan&, Size n) { return reading("v 0 0 0\ng" + repeated(" \\", n), MeshFormat::obj); }},
      {"OBJ number of many digits", 4'000'000,
       [](const Plan&, Size n) { return reading("v 0." + repeated("0", n) + "1 0 0", MeshFormat::obj); }},
      {"OFF vertex line of many numbers", 400'000,
       [](const Plan&, Size n) { return reading("OFF 1 0\n0 0 0" + repeated(" 1", n), MeshFormat::off); }},
      {"PDB of many frames", 20'000,
       [](const Plan&, Size n) {
         return [text = adversarial::pdb_of_frames(n)] { core::read_pdb(text, "adversarial", {}); };
       }},
      {"PDB of alternating chains", 20'000,
       [](const Plan&, Size n) {
         return
             [text = adversarial::pdb_of_alternating_chains(n)] { core::read_pdb(text, "adversarial", {}); };
       }},
      {"mmCIF of many models and chains", 20'000,
       [](const Plan&, Size n) {
         return [text = adversarial::mmcif_of_models(n)] { core::read_mmcif(text, "adversarial", {}); };
       }},
      {"CIF of many blocks", 20'000,
       [](const Plan&, Size n) {
         return [text = adversarial::cif_of_blocks(n)] { core::read_mmcif(text, "adversarial", {}); };
       }},
      {"specification of many entries", 100'000,
       [](const Plan&, Size n) {
         return [text = "a:b=c" + repeated(",b=c", n)] {
           core::ParameterReader reader(core::parse_specification(text, "field"));
           reader.text("b", "", "");
           reader.finish();
         };
       }},
      {"chain of many links", 100'000,
       [](const Plan&, Size n) {
         return [text = "a" + repeated("+a:b=c", n)] { core::to_string(core::parse_chain(text, "method")); };
       }},
      {"repair: triangles at one edge", 50'000,
       [](const Plan&, Size n) { return building(adversarial::book(n), true); }},
      {"repair: triangles on the same vertices", 50'000,
       [](const Plan&, Size n) { return building(adversarial::duplicates(n), true); }},
      {"repair: triangles apart", 50'000,
       [](const Plan&, Size n) { return building(adversarial::apart(n), true); }},
      {"building: triangles around a vertex", 50'000,
       [](const Plan&, Size n) { return building(adversarial::fan(n), false); }},
  };
  for (const adversarial::PolygonFamily& polygon : adversarial::simple_polygons())
    families.push_back({"polygon: " + polygon.name, 10'000,
                        [make = polygon.make](const Plan&, Size n) { return cutting(make(n)); }});
  return families;
}

}  // namespace morsel::benchmark
