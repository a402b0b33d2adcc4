// Inputs that took time quadratic in their size: they are as large here as would have taken minutes.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <random>
#include <stop_token>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_records.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/mesh/mesh_repair.h"
#include "morsel/core/mesh/polygon_triangulation.h"
#include "morsel/core/parallel/hash_index.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/core/parallel/stop.h"
#include "morsel/core/text/text_chunks.h"
#include "support/adversarial.h"
#include "support/molecules.h"

using namespace morsel;
using namespace morsel::test;
using core::MeshFormat;

namespace {

core::LoadedSoup parse(const std::string& bytes, MeshFormat format, const core::Progress& progress = {}) {
  return core::parse_polygon_soup(bytes, format, "file", progress);
}

struct EqualHashes {
  static constexpr int kFree = -1;
  static std::size_t hash(int key) { return static_cast<std::size_t>(key % 3); }
  static int key(int entry) { return entry; }
  static bool equal(int a, int b) { return a == b; }
  static bool less(int a, int b) { return a < b; }
};

std::string replaced(std::string text, std::string_view what, std::string_view with) {
  return text.replace(text.find(what), what.size(), with);
}

}  // namespace

TEST_CASE("a PLY header of 200,000 properties is read, and a name that comes twice is found") {
  const std::string text = adversarial::ply_with_properties(200'000);
  const core::LoadedSoup soup = parse(text, MeshFormat::ply);
  CHECK(soup.properties.size() == 200'000);
  CHECK(soup.soup.polygon_count() == 1);
  CHECK_THROWS_WITH(parse(replaced(text, "p199999\n", "p0\n"), MeshFormat::ply),
                    Catch::Contains("property \"p0\" is declared twice"));
}

TEST_CASE("a PLY header of 200,000 elements is read, and a name that comes twice is found") {
  const std::string text = adversarial::ply_with_elements(200'000);
  CHECK(parse(text, MeshFormat::ply).soup.polygon_count() == 1);
  CHECK_THROWS_WITH(parse(replaced(text, "e199999 0", "e0 0"), MeshFormat::ply),
                    Catch::Contains("element \"e0\" is declared twice"));
}

TEST_CASE("elements of a PLY file may have properties of the same names") {
  const std::string text =
      replaced(adversarial::ply_with_elements(2), "face 1\n", "face 1\nproperty float x\n");
  CHECK(parse(replaced(text, "\n3 0 1 2", "\n7 3 0 1 2"), MeshFormat::ply).soup.polygon_count() == 1);
}

TEST_CASE("an STL file of 300,000 points with the same hash is welded") {
  std::vector<Point> points = adversarial::colliding_points(150'000);
  const std::size_t distinct = points.size();
  for (std::size_t i = 0; i < distinct; ++i) points.push_back(points[distinct - 1 - i]);
  const core::PolygonSoup soup = parse(adversarial::ascii_stl(points), MeshFormat::stl).soup;
  REQUIRE(soup.positions.size() == distinct);
  CHECK(std::equal(soup.positions.begin(), soup.positions.end(), points.begin()));
  std::vector<core::Index> expected(2 * distinct);
  for (std::size_t i = 0; i < distinct; ++i)
    expected[i] = expected[2 * distinct - 1 - i] = static_cast<core::Index>(i);
  CHECK(soup.corners == expected);
}

TEST_CASE("a hash index finds its entries whether their hashes are equal or not") {
  core::HashIndex<int, EqualHashes> index;
  std::vector<int> keys(20'000);
  std::iota(keys.begin(), keys.end(), 0);
  std::shuffle(keys.begin(), keys.end(), std::mt19937(1));
  for (std::size_t i = 0; i < keys.size(); i += 2) {
    CHECK(index.insert(keys[i]));
    CHECK_FALSE(index.insert(keys[i / 4 * 2]));
  }
  CHECK(index.size() == keys.size() / 2);
  CHECK(index.overflow() > 0);
  for (std::size_t i = 0; i < keys.size(); ++i) CHECK(index.find(keys[i]) == (i % 2 == 0 ? keys[i] : -1));
}

TEST_CASE("an edge set takes 300,000 edges with the same hash") {
  core::EdgeSet edges;
  const std::vector<std::array<core::Index, 2>> all = adversarial::colliding_edges(300'000);
  for (const auto& [a, b] : all) edges.insert(a, b);
  for (const auto& [a, b] : all) CHECK(edges.contains(b, a));
  CHECK_FALSE(edges.contains(0, 1));
}

TEST_CASE("progress is reported within lines and lists of any length") {
  const core::ThreadLimit limit(1);  // pieces that are read in parallel report nothing
  const auto reports = [](const std::string& bytes, MeshFormat format) {
    int count = 0;
    try {
      parse(bytes, format, core::Progress([&](std::string_view, double) { ++count; }));
    } catch (const core::BadInput&) {
    }
    return count;
  };
  std::string words;
  for (int i = 0; i < 1'000'000; ++i) words += " 0";
  std::string ones = words;
  std::replace(ones.begin(), ones.end(), '0', '1');
  CHECK(reports("OFF\n1 1 0\n0 0 0\n1000000" + words + "\n", MeshFormat::off) > 10);
  CHECK(reports("v 0 0 0\nf" + ones + "\n", MeshFormat::obj) > 10);
  CHECK(reports("v 0 0 0\ng" + words + "\\\n" + words + "\n", MeshFormat::obj) > 10);
  CHECK(reports("solid" + words + "\nendsolid", MeshFormat::stl) > 10);
  const auto ply = [](const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uint uchar vertex_indices\nend_header\n";
  };
  CHECK(reports(ply("ascii") + "0 0 0\n0 0 0\n1000000" + words + "\n", MeshFormat::ply) > 10);
  const std::string binary = ply("binary_little_endian") + std::string(24, '\0') +
                             std::string("\x40\x42\x0F\0", 4) + std::string(1'000'000, '\0');
  CHECK(reports(binary, MeshFormat::ply) > 10);
  CHECK(reports(replaced(binary, "vertex_indices", "material_numbers"), MeshFormat::ply) == 1);  // refused
  CHECK(reports(replaced(binary, "element face", "element thing"), MeshFormat::ply) > 10);
}

TEST_CASE("a stop ends the reading of a text in parallel pieces") {
  std::stop_source stop;
  const core::Progress progress([](std::string_view, double) { FAIL("reported from another thread"); },
                                stop.get_token());
  const core::Progress piece = progress.unreported();
  CHECK_NOTHROW(piece.update("reading", 0));
  stop.request_stop();
  CHECK_THROWS_AS(piece.update("reading", 0.5), core::Cancelled);
  CHECK_THROWS_AS(core::items_before(
                      {"a", "b"}, [](std::string_view) { return 1; }, progress),
                  core::Cancelled);
}

TEST_CASE("the building and the repair of a mesh can be stopped") {
  const Soup soup = torus(40, 40);
  core::PolygonSoup polygons;
  polygons.positions = soup.positions;
  for (const core::Triangle& t : soup.triangles) polygons.add_polygon(t);
  core::TriangleSoup triangles{soup.positions, soup.triangles, {}};
  core::RepairCounts counts;
  std::stop_source stop;
  stop.request_stop();
  const core::StopScope scope(stop.get_token());
  CHECK_THROWS_AS(core::find_defects(soup.positions, soup.triangles), core::Cancelled);
  CHECK_THROWS_AS(core::repair_triangles(triangles, counts), core::Cancelled);
  CHECK_THROWS_AS(core::build_mesh(polygons), core::Cancelled);
  CHECK_THROWS_AS(core::build_mesh(polygons, {.repair = true}), core::Cancelled);
}

TEST_CASE("a PDB file of 100,000 frames, and one whose chains alternate 200,000 times, are read") {
  const core::AtomRecords frames = core::read_pdb(adversarial::pdb_of_frames(100'000), "file", {});
  CHECK(frames.models == 100'000);
  CHECK(frames.records.size() == 1);
  const core::AtomRecords stretches =
      core::read_pdb(adversarial::pdb_of_alternating_chains(200'000), "file", {});
  CHECK(stretches.models == 1);
  CHECK(stretches.records.size() == 200'000);
  CHECK(std::is_sorted(stretches.records.begin(), stretches.records.end(), [](const auto& a, const auto& b) {
    return a.atom.position.x() < b.atom.position.x();
  }));
}

TEST_CASE("atoms of a PDB file come residue by residue within a stretch of a chain") {
  const auto atom = [](const char* residue, char chain, int number, double x) {
    std::array<char, 90> line;
    std::snprintf(line.data(), line.size(),
                  "ATOM      1  CA  %3s %c%4d    %8.3f%8.3f%8.3f  1.00  0.00           C  \n", residue, chain,
                  number, x, 0.0, 0.0);
    return std::string(line.data());
  };
  const std::string text = atom("ALA", 'A', 1, 1) + atom("GLY", 'A', 2, 2) + atom("ALA", 'A', 1, 3) +
                           "TER\n" + atom("ALA", 'A', 2, 4) + atom("GLY", 'A', 2, 5) +
                           atom("GLY", 'B', 1, 6) + atom("ALA", 'A', 1, 7) + "END\n" + atom("ALA", 'A', 1, 8);
  std::string order;
  for (const core::AtomRecord& record : core::read_pdb(text, "file", {}).records)
    order += std::to_string(static_cast<int>(record.atom.position.x()));
  CHECK(order == "1325467");
}

TEST_CASE("models of a PDB file are counted in its order, whatever their numbers") {
  const std::string atom = pdb_line({}, 1);
  const auto read = [](const std::string& text, std::int64_t model = 1) {
    return core::read_pdb(text, "file", {}, model);
  };
  CHECK(read("MODEL        1\nENDMDL\nMODEL        2\n" + atom + "ENDMDL\nMODEL        1\n" + atom).models ==
        2);
  const core::AtomRecords open = read("MODEL        1\n" + atom + "MODEL        2\n" + atom + atom, 2);
  CHECK(open.records.size() == 2);
  CHECK(open.warnings ==
        std::vector<std::string>{"line 3: a model begins before the one before it has ended (ENDMDL)"});
  const core::AtomRecords twice = read("MODEL        1\n" + atom + "ENDMDL\nMODEL        1\n" + atom);
  CHECK(twice.models == 2);
  CHECK(twice.records.size() == 1);
  CHECK(twice.warnings == std::vector<std::string>{"line 4: another model has the number 1, too; models are "
                                                   "counted in the order of the file"});
  const core::AtomRecords outside = read("MODEL        2\n" + atom + "ENDMDL\n" + atom);
  CHECK(outside.models == 2);
  CHECK(outside.warnings == std::vector<std::string>{"line 4: an atom is in no model, where others are; such "
                                                     "atoms are a model of their own"});
  CHECK(read("MODEL        1\n" + atom + "ENDMDL\nMODEL        2\nATOM damaged\nENDMDL\n").records.size() ==
        1);
}

TEST_CASE("an mmCIF file of 100,000 models and chains is read") {
  const core::AtomRecords all = core::read_mmcif(adversarial::mmcif_of_models(100'000), "file", {});
  CHECK(all.models == 100'000);
  CHECK(all.records.size() == 1);
  CHECK(core::read_mmcif(adversarial::mmcif_of_models(100), "file", {}, 100).records.at(0).atom.chain ==
        "C99");
}

TEST_CASE("a CIF file of 200,000 blocks is read, and names that come twice are found") {
  const std::string text = adversarial::cif_of_blocks(200'000);
  const auto read = [](const std::string& cif) { return core::read_mmcif(cif, "file", {}); };
  CHECK(read(text).records.empty());
  CHECK_THROWS_WITH(read(text + "data_B7\n_a.b 1\n"), "file is damaged: duplicate block name: B7");
  CHECK_THROWS_WITH(read("data_x\n_a.b 1\n_A.B 1\n"), "file, line 3 in data_x: duplicate tag _A.B");
  CHECK_THROWS_WITH(read("data_x\nloop_\n_a.b\n_a.B\n1 1\n"), Catch::Contains("duplicate tag _a.B"));
}

TEST_CASE("meshes whose triangles share an edge, a vertex, all vertices or none are repaired") {
  constexpr std::size_t n = 50'000;
  const auto triangles_left = [](const Soup& soup) {
    core::PolygonSoup polygons;
    polygons.positions = soup.positions;
    for (const core::Triangle& t : soup.triangles) polygons.add_polygon(t);
    return core::build_mesh(polygons, {.repair = true}).mesh.triangle_count();
  };
  CHECK(triangles_left(adversarial::book(n)) == n);
  CHECK(triangles_left(adversarial::fan(n)) == n);
  CHECK(triangles_left(adversarial::duplicates(n)) == 1);
  CHECK(triangles_left(adversarial::apart(n)) == n);
}
