// What the columns of a PDB file and the serial numbers of a script have room for; what the files hold is
// compared in tests/cli/test_residues.py.

#include "morsel/tools/export/residues_file.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;

namespace {

core::Atom carbon(std::int64_t serial, const std::string& chain, const std::string& sequence_id) {
  core::Atom atom;
  atom.element = atom.name = "C";
  atom.residue = "GLY";
  atom.chain = chain;
  atom.sequence_id = sequence_id;
  atom.serial = serial;
  return atom;
}

core::Atom nitrogen(std::int64_t serial, const std::string& chain, const std::string& sequence_id) {
  core::Atom atom = carbon(serial, chain, sequence_id);
  atom.element = atom.name = "N";
  return atom;
}

/// What is written of atoms that are in one segment each.
std::string written(const std::string& name, const std::vector<core::Atom>& atoms,
                    const std::vector<core::Index>& segments) {
  const Scratch folder;
  tools::SegmentedAtoms level;
  for (core::Index i = 0; i < atoms.size(); ++i) {
    level.atoms.push_back({segments[i], i, 1.0});
    if (segments[i] >= level.palette.size()) level.palette.resize(segments[i] + 1, tools::Color::Zero());
  }
  const tools::Provenance provenance("test", tools::Json::object(), {});
  tools::write_residues(folder / name, atoms, std::vector{level}, false, provenance);
  std::ifstream file(folder / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a segment that the column of temperature factors has no room for is refused") {
  const std::vector<core::Atom> atoms = {carbon(1, "A", "1")};
  CHECK_THAT(written("a.pdb", atoms, {999}), Catch::Contains("  1.00999.00 "));
  CHECK_THAT(written("a.pdb", atoms, {9999}), Catch::Contains("  1.009999.0 "));
  CHECK_THAT(written("a.pdb", atoms, {999'999}), Catch::Contains("  1.00999999 "));
  CHECK_THROWS_AS(written("a.pdb", atoms, {1'000'000}), core::BadInput);
  CHECK_THROWS_WITH(written("a.pdb", atoms, {1'000'000}),
                    Catch::Contains("segment 1000000") && Catch::Contains("write the residues as .csv"));
}

TEST_CASE("residues that have no name of their own are named by runs of serial numbers") {
  // Two residues 1 of chain A; one without a chain; residue 2, which is the only one.
  const std::vector<core::Atom> atoms = {carbon(1, "A", "1"), nitrogen(3, "A", "1"), carbon(4, "A", "2"),
                                         carbon(5, "", "9"),  carbon(6, "", "10"),   carbon(8, "A", "1")};
  CHECK_THAT(written("a.pml", atoms, {0, 0, 0, 0, 0, 0}),
             Catch::Contains("select segment_0, (chain A and resi 2) or (id 1-3+5-6+8)\n"));
  CHECK_THAT(written("a.cxc", atoms, {0, 0, 0, 0, 0, 0}),
             Catch::Contains("name segment_0 /A:2 | (@@serial_number>=1 & @@serial_number<=3 ) | "
                             "(@@serial_number>=5 & @@serial_number<=6 ) | @@serial_number=8\n"));
}

TEST_CASE("atoms that a script cannot tell apart by their serial numbers are refused") {
  const std::vector<core::Atom> twice = {carbon(1, "A", "1"), carbon(1, "", "2")};
  CHECK_THROWS_WITH(written("a.pml", twice, {0, 1}),
                    Catch::Contains("no script can tell") && Catch::Contains("the same serial number"));
  const std::vector<core::Atom> named = {carbon(1, "A", "1"), carbon(1, "A", "2")};
  CHECK_THAT(written("a.pml", named, {0, 1}), Catch::Contains("select segment_1, (chain A and resi 2)\n"));
  CHECK_THROWS_WITH(written("a.cxc", {carbon(-1, "", "1")}, {0}), Catch::Contains("negative serial number"));
}
