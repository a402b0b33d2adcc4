// The outcome of every file of the corpus, compared with tests/corpus/expected.txt. If a change is meant, set
// MORSEL_ACTUAL to a file that receives the new table, and read the difference before you keep it.

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "support/corpus.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;

namespace {

std::string outcome(const CorpusFile& file, bool repair) {
  std::ostringstream text;
  try {
    const core::LoadedMesh loaded = core::read_mesh(file.path, {.repair = repair});
    const core::TriangleMesh& mesh = loaded.mesh;
    mesh.validate();
    text << mesh.vertex_count() << " vertices, triangles";
    for (const core::Triangle& t : mesh.triangles()) {
      text << ' ';
      for (int i = 0; i < 3; ++i) text << (i > 0 ? "-" : "") << t[i];
    }
    text << ", chi " << mesh.euler_characteristic();
    if (!loaded.source.numbering.to_input.empty()) {
      text << ", of input vertices";
      for (const core::Index v : loaded.source.numbering.to_input) text << ' ' << v;
    }
    for (const auto& p : loaded.source.properties) text << ", " << p.name;
    for (const auto& r : loaded.source.repairs) text << ", " << r.action << ' ' << r.count;
    for (const std::string& warning : loaded.source.warnings) text << "; warning: " << warning;
  } catch (const core::BadInput& error) {
    std::string sentence = error.what();
    const std::size_t at = sentence.find(file.path);
    REQUIRE(at != std::string::npos);  // every refusal names the file
    text << sentence.erase(at, file.path.size() - file.name.size());
  }
  return text.str();
}

}  // namespace

TEST_CASE("every file of the corpus has its expected outcome") {
  std::string actual;
  for (const CorpusFile& file : mesh_corpus()) {
    const std::string plain = outcome(file, false);
    const std::string repaired = outcome(file, true);
    actual += file.name + "\n  plain:  " + plain +
              "\n  repair: " + (repaired == plain ? "the same" : repaired) + "\n";
  }
  if (const char* path = std::getenv("MORSEL_ACTUAL")) std::ofstream(path) << actual;

  std::istringstream got(actual);
  std::istringstream expected(contents(corpus_folder() + "/expected.txt"));
  std::string got_line, expected_line;
  while (std::getline(expected, expected_line)) {
    std::getline(got, got_line);
    CHECK(got_line == expected_line);
  }
  CHECK_FALSE(std::getline(got, got_line));
}

TEST_CASE("what is listed as repairable is repaired, and what is not is refused") {
  using Kinds = std::set<core::DefectKind>;
  std::size_t repaired = 0, refused = 0;
  for (const CorpusFile& file : mesh_corpus()) {
    INFO(file.name);
    const auto defects = [&](bool repair) {
      std::optional<Kinds> kinds;
      try {
        core::read_mesh(file.path, {.repair = repair});
        kinds.emplace();
      } catch (const core::MeshError& error) {
        kinds.emplace();
        for (const core::Defect& defect : error.defects())
          // With faces that name missing vertices nothing is repaired.
          if (core::repair_of(defect.kind).empty()) kinds->insert(defect.kind);
        if (repair) CHECK_FALSE(kinds->empty());
      } catch (const core::BadInput&) {  // no polygons
      }
      return kinds;
    };
    const std::optional<Kinds> predicted = defects(false);
    CHECK(predicted == defects(true));
    if (predicted) ++(predicted->empty() ? repaired : refused);
  }
  CHECK(repaired > 10);
  CHECK(refused > 4);
}
