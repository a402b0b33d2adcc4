#include "morsel/core/io/molecule.h"

#include <catch2/catch.hpp>
#include <functional>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_records.h"
#include "support/molecules.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using Catch::Contains;
using core::HeteroAtoms;
using core::Molecule;
using core::MoleculeOptions;

namespace {

/// Two chains, a modified residue, a ligand, an ion, two waters, a hydrogen, and alternate locations at two
/// residues.
std::vector<AtomLine> small_protein() {
  std::vector<AtomLine> atoms = {
      {"N", "GLY", "A", 1, {1.5, -2.25, 3.125}, "N"},
      {"CA", "GLY", "A", 1, {2.5, 0, 0}, "C"},
      {"HA2", "GLY", "A", 1, {2.5, 1, 0}, "H"},
      {"CB", "SER", "A", 2, {4, 0, 0}, "C", false, 'A', 0.4},
      {"CB", "SER", "A", 2, {4, 1, 0}, "C", false, 'B', 0.6},
      {"OG", "SER", "A", 2, {5, 0, 0}, "O", false, 'A', 0.4},
      {"OG", "SER", "A", 2, {5, 1, 0}, "O", false, 'B', 0.6},
      {"CA", "SER", "A", 2, {4, 0, 1}, "C"},
      {"CG", "LEU", "B", 1, {7, 0, 0}, "C", false, 'C', 0.5},
      {"CG", "LEU", "B", 1, {7, 1, 0}, "C", false, 'D', 0.5},
      {"SE", "MSE", "B", 2, {9, 0, 0}, "SE", true},
      {"CA", "CA", "B", 3, {12, 0, 0}, "CA", true},
      {"C1", "MPD", "B", 4, {14, 0, 0}, "C", true},
      {"O", "HOH", "A", 101, {16, 0, 0}, "O", true},
      {"O", "HOH", "B", 102, {18, 0, 0}, "O", true},
  };
  return atoms;
}

Molecule read(const std::string& text, const std::string& extension, const MoleculeOptions& options = {}) {
  const Scratch folder;
  return core::read_molecule(folder.file("molecule" + extension, text), options);
}

/// By their numbers in the file.
std::vector<std::int64_t> serials(const Molecule& molecule) {
  std::vector<std::int64_t> numbers;
  for (const core::Atom& atom : molecule.atoms) numbers.push_back(atom.serial);
  return numbers;
}
using Serials = std::vector<std::int64_t>;

/// The same from both formats.
void check_both(const Serials& expected, const std::function<void(MoleculeOptions&)>& change) {
  MoleculeOptions options;
  change(options);
  CHECK(serials(read(pdb_text(small_protein()), ".pdb", options)) == expected);
  CHECK(serials(read(mmcif_text(small_protein()), ".cif", options)) == expected);
}

}  // namespace

TEST_CASE("atoms are read with all their attributes") {
  for (const std::string extension : {".pdb", ".ent", ".PDB", ".cif", ".mmcif"}) {
    CAPTURE(extension);
    const bool cif = extension.find("cif") != std::string::npos;
    const Molecule molecule = read(cif ? mmcif_text(small_protein()) : pdb_text(small_protein()), extension);
    REQUIRE(serials(molecule) == Serials{1, 2, 3, 5, 7, 8, 9, 11});
    CHECK(molecule.atoms_in_model == 15);
    CHECK(molecule.models == 1);
    CHECK(molecule.left_out.waters == 2);
    CHECK(molecule.left_out.hetero == 2);
    CHECK(molecule.left_out.alternates == 3);
    CHECK(molecule.left_out.total() == 7);
    CHECK(molecule.left_out.described() == "2 of waters, 2 hetero, 3 at other alternate locations");
    const core::Atom& n = molecule.atoms[0];
    CHECK(n.position == core::Point(1.5, -2.25, 3.125));
    CHECK(n.radius == 1.55);
    CHECK(n.element == "N");
    CHECK(n.name == "N");
    CHECK(n.residue == "GLY");
    CHECK(n.chain == "A");
    CHECK(n.sequence_id == "1");
    CHECK(n.alternate == 0);
    CHECK_FALSE(n.hetero);
    CHECK(n.polymer);
    CHECK(n.described() == "atom 1 (N of GLY 1, chain A)");
    CHECK(molecule.atoms[2].radius == 1.2);
    CHECK(molecule.atoms[3].alternate == 'B');
    CHECK(molecule.atoms[3].occupancy == Approx(0.6));
    const core::Atom& se = molecule.atoms.back();
    CHECK(se.element == "Se");
    CHECK(se.radius == 1.9);
    CHECK(se.hetero);
    CHECK(se.polymer);
  }
}

TEST_CASE("options choose atoms") {
  check_both({1, 2, 3, 5, 7, 8, 9}, [](auto& o) { o.hetero = HeteroAtoms::none; });
  check_both({1, 2, 3, 5, 7, 8, 9, 11, 12, 13}, [](auto& o) { o.hetero = HeteroAtoms::all; });
  check_both({1, 2, 3, 5, 7, 8, 9, 11, 14, 15}, [](auto& o) { o.waters = true; });
  check_both({1, 2, 5, 7, 8, 9, 11}, [](auto& o) { o.hydrogens = false; });
  check_both({1, 2, 3, 4, 6, 8, 9, 11}, [](auto& o) { o.alternate = "first"; });
  check_both({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, [](auto& o) { o.alternate = "all"; });
  check_both({1, 2, 3, 8, 10, 11}, [](auto& o) { o.alternate = "D"; });
  check_both({9, 11}, [](auto& o) { o.chains = {"B"}; });
  check_both({1, 2, 3, 5, 7, 8, 9, 11}, [](auto& o) { o.chains = {"B", "A"}; });
}

TEST_CASE("one model is taken") {
  std::vector<AtomLine> atoms = {{"C1"}, {"C2"}};
  const std::string pdb = "MODEL        3\n" + pdb_line(atoms[0], 1) + "ENDMDL\nMODEL        7\n" +
                          pdb_line(atoms[1], 2) + "ENDMDL\n";
  atoms[0].model = 3;
  atoms[1].model = 7;
  for (const auto& [text, extension] : {std::pair(pdb, ".pdb"), std::pair(mmcif_text(atoms), ".cif")}) {
    MoleculeOptions options;
    CHECK(read(text, extension).atoms[0].name == "C1");
    CHECK(read(text, extension).models == 2);
    options.model = 2;
    CHECK(read(text, extension, options).atoms[0].name == "C2");
    options.model = 3;
    CHECK_THROWS_WITH(read(text, extension, options), Contains("no model 3, it has 2"));
    options.model = 0;
    CHECK_THROWS_AS(read(text, extension, options), core::InvalidArgument);
  }
}

TEST_CASE("a file without atoms is refused with what was left out") {
  CHECK_THROWS_WITH(read("", ".pdb"), Contains("molecule.pdb has no atoms"));
  CHECK_THROWS_WITH(read("HEADER    X\nEND\n", ".pdb"), Contains("has no atoms"));
  CHECK_THROWS_WITH(read("data_X\n_cell.length_a 3\n", ".cif"), Contains("has no atoms"));
  const std::string waters =
      pdb_text({{"O", "HOH", "A", 1, {0, 0, 0}, "O", true}, {"O", "HOH", "A", 2, {9, 0, 0}, "O", true}});
  CHECK_THROWS_WITH(read(waters, ".pdb"), Contains("no atoms left of 2: the options leave out 2 of waters"));
  MoleculeOptions options;
  options.chains = {"A", "Q"};
  CHECK_THROWS_WITH(read(pdb_text(small_protein()), ".pdb", options),
                    Contains("no chain \"Q\"") && Contains("\"A\", \"B\""));
  options.chains = {"A"};
  options.alternate = "highestt";
  CHECK_THROWS_AS(read(pdb_text(small_protein()), ".pdb", options), core::InvalidArgument);
}

TEST_CASE("damaged files are refused with the place") {
  const std::string good = pdb_line({}, 1);
  const auto with = [&](std::size_t column, const std::string& text) {
    std::string line = good;
    line.replace(column, text.size(), text);
    return good + line;
  };
  CHECK_THROWS_WITH(read(with(38, "  1.x0  "), ".pdb"), Contains("line 2") && Contains("\"1.x0\""));
  CHECK_THROWS_WITH(read(with(46, "     nan"), ".pdb"), Contains("coordinate z") && Contains("\"nan\""));
  CHECK_THROWS_WITH(read(with(30, "        "), ".pdb"), Contains("coordinate x"));
  CHECK_THROWS_WITH(read(good + good.substr(0, 45), ".pdb"), Contains("line 2") && Contains("column 54"));
  CHECK_THROWS_WITH(read(with(76, "Xx"), ".pdb"), Contains("no known element"));
  CHECK_THROWS_WITH(read(mmcif_text({{}}), ".pdb"), Contains("CIF file"));
  const std::string cif = mmcif_text({{}});
  CHECK_THROWS_WITH(read(cif + "_oops\n", ".cif"), Contains("molecule.cif, line 19 "));
  CHECK_THROWS_WITH(read(cif.substr(0, cif.size() - 10), ".cif"),
                    Contains("molecule.cif, line 3: ") && Contains("loop"));
  CHECK_THROWS_WITH(read("data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n1 C\n", ".cif"),
                    Contains("Cartn_x"));
  std::string letters = cif;
  letters.replace(letters.find("0.000"), 5, "zero!");
  CHECK_THROWS_WITH(read(letters, ".cif"),
                    Contains("atom 1") && Contains("Cartn_x") && Contains("\"zero!\""));
  CHECK_THROWS_WITH(read("data_x\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0.5\n", ".cif"),
                    Contains("fractional"));
  CHECK_THROWS_WITH(read("", ".xyz"), Contains(".mmcif") && Contains(".xyz"));
  CHECK_THROWS_WITH(read("", ".pdb.gz"), Contains("has no atoms"));
  CHECK_THROWS_WITH(core::read_molecule("no/such/file.pdb"), Contains("no/such/file.pdb"));
  CHECK_THROWS_AS(core::read_molecule("/"), core::BadInput);
}

TEST_CASE("a file cut or spoiled anywhere is read or refused") {
  for (const bool cif : {false, true}) {
    const std::string whole =
        cif ? mmcif_text(small_protein()) : "MODEL        1\n" + pdb_text(small_protein());
    const auto attempt = [&](const std::string& text) {
      try {
        const core::AtomRecords all =
            cif ? core::read_mmcif(text, "molecule", {}) : core::read_pdb(text, "molecule", {});
        for (const core::AtomRecord& record : all.records)
          if (!record.atom.position.allFinite() || record.model > all.models) FAIL(text);
      } catch (const core::BadInput& error) {
        if (std::string(error.what()).find("molecule") == std::string::npos) FAIL(error.what());
      }
    };
    for (std::size_t n = 0; n < whole.size(); ++n) {
      attempt(whole.substr(0, n));
      for (const char c : {'\0', '\n', '\'', 'Z', '_', '9', '\xff'}) {
        std::string spoiled = whole;
        spoiled[n] = c;
        attempt(spoiled);
      }
    }
  }
}

TEST_CASE("records without atoms are not parsed") {
  const std::string text =
      "LINK   nonsense\nSSBOND 1\nREMARK\nANISOU  1\nMTRIX4\nCRYST1 x y z\r\n" + pdb_line({}, 1);
  CHECK(read(text, ".pdb").atoms.size() == 1);
  CHECK(read(text + "END\n" + pdb_line({}, 2).substr(0, 20), ".pdb").atoms.size() == 1);
}

TEST_CASE("molecule options are read back from their keys") {
  core::ParameterReader reader(
      {"m", {{"hetero", "all"}, {"waters", "yes"}, {"altloc", "B"}, {"chains", "A/B\\/C"}, {"model", "2"}}});
  const MoleculeOptions options = core::read_molecule_options(reader);
  reader.finish();
  CHECK(options.hetero == HeteroAtoms::all);
  CHECK(options.waters);
  CHECK(options.hydrogens);
  CHECK(options.alternate == "B");
  CHECK(options.chains == std::vector<std::string>{"A", "B/C"});
  CHECK(options.model == 2);
  const core::Parameters expected = {{"hetero", std::string("all")},
                                     {"waters", true},
                                     {"hydrogens", true},
                                     {"altloc", std::string("B")},
                                     {"chains", std::string("A/B\\/C")},
                                     {"model", std::int64_t{2}}};
  CHECK(core::molecule_parameters(options) == expected);
  core::ParameterReader bad({"m", {{"altloc", "some"}}});
  CHECK_THROWS_AS(core::read_molecule_options(bad), core::InvalidArgument);
}
