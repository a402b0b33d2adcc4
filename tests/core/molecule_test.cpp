#include "morsel/core/io/molecule.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <functional>
#include <initializer_list>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_radii.h"
#include "morsel/core/io/atom_records.h"
#include "morsel/core/io/atom_selection.h"
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
  const std::string ligand = pdb_line({"Q1", "LIG", "A", 1, {0, 0, 0}, "Xx"}, 2);
  CHECK_THROWS_WITH(read(good + ligand, ".pdb"), Contains("no known element"));
  CHECK_THROWS_WITH(read(mmcif_text({{}}), ".pdb"), Contains("CIF file"));
  const std::string cif = mmcif_text({{}});
  CHECK_THROWS_WITH(read(cif + "_oops\n", ".cif"), Contains("molecule.cif, line 19 "));
  CHECK_THROWS_WITH(read(cif.substr(0, cif.size() - 10), ".cif"),
                    Contains("molecule.cif, line 3: ") && Contains("loop"));
  CHECK_THROWS_WITH(read("data_x\nloop_\n_chem_comp_atom.comp_id\n_chem_comp_atom.atom_id\nHEM FE\n", ".cif"),
                    Contains("chemical component (\"HEM\")"));
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

TEST_CASE("a molecule is read in a format that is given, from a file of any name or from bytes") {
  const std::string pqr = "ATOM      1  N   GLY A   1      1.000   2.000   3.000  -0.4157 1.8240\nEND\n";
  const Scratch folder;
  const std::filesystem::path file = folder.file("molecule.dat", pqr);
  CHECK(core::read_molecule(file, core::MoleculeFormat::pqr).atoms.at(0).radius == 1.824);
  const Molecule parsed = core::parse_molecule(pqr, core::MoleculeFormat::pqr, "standard input");
  CHECK(parsed.atoms.at(0).radius == 1.824);
  CHECK_THROWS_WITH(
      core::parse_molecule("OFF\n0 0 0\n", core::MoleculeFormat::pdb, "standard input"),
      Contains("\"standard input\": it is an OFF file, though the format that was given is pdb"));
  for (const std::string& name : core::molecule_format_names())
    CHECK_NOTHROW(core::molecule_format_named(name));
  CHECK_THROWS_WITH(core::molecule_format_named("cif"), Contains("only pdb, mmcif and pqr"));
}

TEST_CASE("a file cut or spoiled anywhere is read or refused") {
  const std::string pqr = "ATOM      1  N   GLY A   1      1.000   2.000   3.000  -0.4157 1.8240\nEND\n";
  for (const std::string& whole :
       {mmcif_text(small_protein()),
        "SEQRES   1 A    2  GLY SER\nMODEL        1\n" + pdb_text(small_protein()), pqr}) {
    const auto attempt = [&](const std::string& text) {
      try {
        const core::AtomRecords all = whole == pqr                 ? core::read_pqr(text, "molecule", {})
                                      : whole.starts_with("data_") ? core::read_mmcif(text, "molecule", {})
                                                                   : core::read_pdb(text, "molecule", {});
        for (const core::AtomRecord& record : all.records)
          if (!record.atom.position.allFinite() || all.models < 1) FAIL(text);
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
                                     {"model", std::int64_t{2}},
                                     {"radii", std::string("auto")}};
  CHECK(core::molecule_parameters(options) == expected);
  core::ParameterReader selecting({"m", {{"select", "chain A\\, B"}, {"radii", "mine.txt"}}});
  const MoleculeOptions selected = core::read_molecule_options(selecting);
  CHECK(selected.select == "chain A, B");
  CHECK(selected.radii == "mine.txt");
  CHECK(selecting.files().size() == 1);
  CHECK(core::molecule_parameters(selected)[0] == core::Parameters{{"select", std::string("chain A, B")}}[0]);
  core::ParameterReader both({"m", {{"select", "all"}, {"waters", "yes"}}});
  CHECK_THROWS_WITH(core::read_molecule_options(both), Contains("takes the place of hetero and waters"));
  core::ParameterReader bad({"m", {{"altloc", "some"}}});
  CHECK_THROWS_AS(core::read_molecule_options(bad), core::InvalidArgument);
}

namespace {

/// A line of the columns that programs of simulations write, without an element: `name` as columns 13 to 16
/// have it, `residue` as 18 to 21.
std::string md_line(int serial, const std::string& name, const std::string& residue, int number,
                    const core::Point& p, const std::string& rest = "") {
  std::array<char, 120> line{};
  std::snprintf(line.data(), line.size(), "ATOM  %5d %-4s %-4s %4d    %8.3f%8.3f%8.3f  1.00  0.00%s\n",
                serial, name.c_str(), residue.c_str(), number, p.x(), p.y(), p.z(), rest.c_str());
  return line.data();
}

std::string elements(const Molecule& molecule) {
  std::string text;
  for (const core::Atom& atom : molecule.atoms) text += (text.empty() ? "" : " ") + atom.element;
  return text;
}

MoleculeOptions everything() {
  MoleculeOptions options;
  options.hetero = HeteroAtoms::all;
  options.waters = true;
  return options;
}

core::Atom only(const std::string& line) {
  const Molecule molecule = read(line, ".pdb", everything());
  REQUIRE(molecule.atoms.size() == 1);
  return molecule.atoms[0];
}

}  // namespace

TEST_CASE("elements follow from the names of atom and residue") {
  struct Case {
    const char *name, *residue, *element;
  };
  for (const auto& [name, residue, element] : std::initializer_list<Case>{
           {"CA  ", "ALA", "C"},  {" CA ", "ALA", "C"},  {"CA  ", "CA", "Ca"},  {"CA", "CA2+", "Ca"},
           {"HT1 ", "MET", "H"},  {"HG11", "VAL", "H"},  {"HG  ", "CYS", "H"},  {"HG  ", "HG", "Hg"},
           {"1HB ", "ALA", "H"},  {"HO5'", "DA", "H"},   {"H5T ", "DA", "H"},   {"CD  ", "LYS", "C"},
           {"CE  ", "LYS", "C"},  {"CD  ", "CD", "Cd"},  {"NE  ", "ARG", "N"},  {"OD1 ", "ASN", "O"},
           {"SD  ", "MET", "S"},  {"SE  ", "MSE", "Se"}, {"OT1 ", "LEU", "O"},  {"SG  ", "CYX", "S"},
           {"HE2 ", "HSE", "H"},  {"CL- ", "CL-", "Cl"}, {"Cl- ", "Cl-", "Cl"}, {"NA+ ", "NA+", "Na"},
           {"NA  ", "NA", "Na"},  {"SOD ", "SOD", "Na"}, {"CLA ", "CLA", "Cl"}, {"POT ", "POT", "K"},
           {"CAL ", "CAL", "Ca"}, {"CES ", "CES", "Cs"}, {"ZN  ", "ZN2", "Zn"}, {"MG  ", "MG", "Mg"},
           {"K+  ", "K+", "K"},   {"BR  ", "BRO", "Br"}, {"OH2 ", "TIP3", "O"}, {"HW1 ", "SOL", "H"},
           {"P   ", "DG", "P"},   {"H2''", "DT5", "H"},  {"CB  ", "NALA", "C"}, {"CL1 ", "LIG", "Cl"},
           {" CL1", "LIG", "C"},  {"FE  ", "HEM", "Fe"}, {" NA ", "HEM", "N"},  {"BR1 ", "DRG", "Br"}}) {
    CAPTURE(name, residue);
    CHECK(only(md_line(1, name, residue, 1, {0, 0, 0})).element == element);
  }
  // CLA is chlorophyll, too, and SOL may be a ligand.
  CHECK(only(md_line(1, "MG  ", "CLA", 1, {0, 0, 0})).element == "Mg");
  CHECK_FALSE(only(md_line(1, "MG  ", "CLA", 1, {0, 0, 0})).ion);
  CHECK_FALSE(only(md_line(1, "C1  ", "SOL", 1, {0, 0, 0})).water);
  CHECK(only(md_line(1, "CA  ", "ALA", 1, {0, 0, 0})).radius == 1.7);
  // In a file whose names begin in column 13 the columns tell nothing.
  const Molecule aligned =
      read(md_line(1, "CA  ", "ALA", 1, {0, 0, 0}) + md_line(2, "NB  ", "LIG", 2, {9, 0, 0}), ".pdb");
  CHECK(elements(aligned) == "C N");
}

TEST_CASE("an element that residue and name exclude is corrected with a warning") {
  const Molecule molecule =
      read(pdb_text({{"CA", "ALA", "A", 1, {0, 0, 0}, "CA"}, {"C", "ALA", "A", 1, {2, 0, 0}, "Xx"}}), ".pdb");
  CHECK(elements(molecule) == "C C");
  REQUIRE(molecule.warnings.size() == 1);
  CHECK_THAT(molecule.warnings[0],
             Contains("2 atoms have elements") && Contains("CA of ALA 1, chain A) is taken as C, not CA"));
}

TEST_CASE("files of CHARMM, AMBER and GROMACS have the atoms of the same file of the PDB") {
  const std::vector<core::Point> at = {
      {0, 0, 0},     {0.6, 0.8, 0}, {1.4, 0, 0},  {1.8, 1, 0.5},  {2, 1.4, 0}, {1.3, 2.4, 0}, {3.3, 1.4, 0},
      {4.2, 2.6, 0}, {20, 0, 0},    {20.9, 0, 0}, {19.7, 0.9, 0}, {30, 0, 0},  {40, 0, 0}};
  const auto text = [&](const std::vector<std::array<const char*, 2>>& names, const std::vector<int>& numbers,
                        const std::string& rest) {
    std::string lines;
    for (std::size_t i = 0; i < names.size(); ++i)
      lines += md_line(static_cast<int>(i) + 1, names[i][0], names[i][1], numbers[i], at[i], rest);
    return lines + "END\n";
  };
  const std::vector<int> numbers = {1, 1, 1, 1, 1, 1, 2, 2, 3, 3, 3, 4, 5};
  const std::string pdb = text({{" N  ", "MET"},
                                {" H1 ", "MET"},
                                {" CA ", "MET"},
                                {" HA ", "MET"},
                                {" C  ", "MET"},
                                {" O  ", "MET"},
                                {" N  ", "HIS"},
                                {" CA ", "HIS"},
                                {" O  ", "HOH"},
                                {" H1 ", "HOH"},
                                {" H2 ", "HOH"},
                                {"NA  ", "NA"},
                                {"CL  ", "CL"}},
                               numbers, "");
  const std::string charmm = text({{" N  ", "MET"},
                                   {" HT1", "MET"},
                                   {" CA ", "MET"},
                                   {" HA ", "MET"},
                                   {" C  ", "MET"},
                                   {" O  ", "MET"},
                                   {" N  ", "HSD"},
                                   {" CA ", "HSD"},
                                   {" OH2", "TIP3"},
                                   {" H1 ", "TIP3"},
                                   {" H2 ", "TIP3"},
                                   {"SOD ", "SOD"},
                                   {"CLA ", "CLA"}},
                                  numbers, "      PROA");
  const std::string amber = text({{"N   ", "NMET"},
                                  {"H1  ", "NMET"},
                                  {"CA  ", "NMET"},
                                  {"HA  ", "NMET"},
                                  {"C   ", "NMET"},
                                  {"O   ", "NMET"},
                                  {"N   ", "HIE"},
                                  {"CA  ", "HIE"},
                                  {"O   ", "WAT"},
                                  {"H1  ", "WAT"},
                                  {"H2  ", "WAT"},
                                  {"Na+ ", "Na+"},
                                  {"Cl- ", "Cl-"}},
                                 numbers, "");
  const std::string gromacs =
      "TITLE     Protein in water\nREMARK    THIS IS A SIMULATION BOX\nMODEL        1\n" +
      text({{"N   ", "MET"},
            {"H1  ", "MET"},
            {"CA  ", "MET"},
            {"HA  ", "MET"},
            {"C   ", "MET"},
            {"O   ", "MET"},
            {"N   ", "HISH"},
            {"CA  ", "HISH"},
            {"OW  ", "SOL"},
            {"HW1 ", "SOL"},
            {"HW2 ", "SOL"},
            {"NA  ", "NA+"},
            {"CL  ", "CL-"}},
           numbers, "");
  const Molecule expected = read(pdb, ".pdb");
  CHECK(expected.atoms.size() == 8);
  for (const std::string& dialect : {charmm, amber, gromacs}) {
    const Molecule molecule = read(dialect, ".pdb");
    CHECK(elements(molecule) == elements(expected));
    CHECK(molecule.left_out.described() == "3 of waters, 2 hetero");
    REQUIRE(molecule.atoms.size() == expected.atoms.size());
    for (std::size_t i = 0; i < molecule.atoms.size(); ++i) {
      CHECK(molecule.atoms[i].position == expected.atoms[i].position);
      CHECK(molecule.atoms[i].radius == expected.atoms[i].radius);
      CHECK(molecule.atoms[i].polymer);
    }
    CHECK(elements(read(dialect, ".pdb", everything())) == "N H C H C O N C O H H Na Cl");
  }
}

TEST_CASE("sites of water models are no atoms") {
  const Molecule molecule =
      read(md_line(1, "OW  ", "SOL", 1, {0, 0, 0}) + md_line(2, "HW1 ", "SOL", 1, {1, 0, 0}) +
               md_line(3, "MW  ", "SOL", 1, {0.1, 0, 0}) + md_line(4, "EPW ", "WAT", 2, {9, 0, 0}),
           ".pdb", everything());
  CHECK(elements(molecule) == "O H");
  CHECK(molecule.warnings ==
        std::vector<std::string>{"2 sites of water models and lone pairs, which are no atoms, are left out"});
}

TEST_CASE("column 21 is of the residue's name or the chain's") {
  CHECK(only("ATOM      1  OH2 TIP3A   2      10.000   0.000   0.000  1.00  0.00\n").residue == "TIP3");
  CHECK(only("ATOM      1  OH2 TIP3A   2      10.000   0.000   0.000  1.00  0.00\n").chain == "A");
  CHECK(only("ATOM      1  CA  ALAAB   2      10.000   0.000   0.000  1.00  0.00\n").chain == "AB");
}

TEST_CASE("what the sequence has is polymer, whatever its record") {
  const std::string atoms =
      "HETATM    1  CA  XYZ A   2       0.000   0.000   0.000  1.00  0.00           C\n"
      "HETATM    2  CA  XYZ B   2       9.000   0.000   0.000  1.00  0.00           C\n";
  const std::string residue = "SEQRES   1 A    3  ALA XYZ GLY\n";
  CHECK(read(residue + atoms, ".pdb").atoms.size() == 1);
  CHECK(read("MODRES 1ABC XYZ B    2  ALA\n" + atoms, ".pdb").atoms[0].chain == "B");
  CHECK_THROWS_AS(read(atoms, ".pdb"), core::BadInput);
  const std::string head = "data_x\nloop_\n_entity_poly_seq.entity_id\n_entity_poly_seq.mon_id\n1 XYZ\n";
  const std::string sites =
      "loop_\n_atom_site.group_PDB\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
      "_atom_site.label_entity_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
      "HETATM CA XYZ 1 0 0 0\nHETATM CA XYZ 2 9 0 0\n";
  CHECK(serials(read(head + sites, ".cif")) == Serials{1});
  CHECK_THROWS_AS(read("data_x\n" + sites, ".cif"), core::BadInput);
}

TEST_CASE("ions and known ligands are left out, whatever their records") {
  const std::string text = md_line(1, "CA  ", "ALA", 1, {0, 0, 0}) + md_line(2, "CLA ", "CLA", 2, {9, 0, 0}) +
                           md_line(3, "C1  ", "GOL", 3, {18, 0, 0}) +
                           md_line(4, "C1  ", "POPC", 4, {27, 0, 0}) +
                           md_line(5, "C1  ", "LIG", 5, {36, 0, 0});
  CHECK(serials(read(text, ".pdb")) == Serials{1, 5});
  CHECK(serials(read(text, ".pdb", everything())) == Serials{1, 2, 3, 4, 5});
}

TEST_CASE("an expression selects atoms") {
  const auto check = [](const Serials& expected, const std::string& expression) {
    CAPTURE(expression);
    check_both(expected, [&](auto& o) {
      o.select = expression;
      o.alternate = "all";
    });
  };
  check({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, "all");
  check({14, 15}, "water");
  check({12}, "ion");
  check({13}, "ligand");
  check({11, 12, 13, 14, 15}, "hetero");
  check({11}, "polymer and hetero");
  check({3}, "hydrogen");
  check({9, 10, 11, 12, 13, 15}, "chain B");
  check({9, 10, 11}, "chain B and polymer");
  check({1, 2, 3, 11}, "resname gly, MSE");
  check({4, 5, 6, 7, 8, 11, 12}, "residue 2-3");
  check({4, 5, 6, 7, 8, 13}, "residue 2-3,4 and not (chain B and residue 2 3)");
  check({2, 8, 12}, "name CA");
  check({12}, "element CA");
  check({2, 8}, "name CA and element C");
  check({1, 14, 15}, "water or name N");
  check({1, 12}, "NOT not name \"N\" OR ion");
  check({1, 2, 3, 14}, "chain A and (residue 1 or residue 101)");
  MoleculeOptions narrowed;
  narrowed.select = "polymer or water";
  narrowed.chains = {"A"};
  narrowed.hydrogens = false;
  const Molecule molecule = read(pdb_text(small_protein()), ".pdb", narrowed);
  CHECK(serials(molecule) == Serials{1, 2, 5, 7, 8, 14});
  CHECK(molecule.left_out.described() == "6 of other chains, 1 hydrogens, 2 at other alternate locations");
  narrowed.select = "resname NONE";
  CHECK_THROWS_WITH(read(pdb_text(small_protein()), ".pdb", narrowed), Contains("9 not selected"));
}

TEST_CASE("residues are selected with their insertion codes") {
  core::Atom atom;
  const auto takes = [&](const std::string& expression, const std::string& place) {
    atom.sequence_id = place;
    return core::AtomSelection(expression).takes(atom);
  };
  CHECK(takes("residue 52", "52"));
  CHECK_FALSE(takes("residue 52", "52A"));
  CHECK(takes("residue 52a", "52A"));
  CHECK(takes("residue 50-52", "51B"));
  CHECK_FALSE(takes("residue 50-52", "52A"));
  CHECK(takes("residue 52-52B", "52A"));
  CHECK(takes("residue -5--2", "-3"));
  CHECK_FALSE(takes("residue -5--2", "3"));
  CHECK(takes("residue -5-2", "0"));
  CHECK_FALSE(takes("residue 1", ""));
}

TEST_CASE("what is no expression is refused with the place") {
  const auto message = [](const std::string& expression) {
    try {
      core::AtomSelection{expression};
    } catch (const core::InvalidArgument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(message(""), Contains("at character 1: a group or property is missing"));
  CHECK_THAT(message("chain A and"), Contains("at character 12"));
  CHECK_THAT(message("chain A chains B or foo"), Contains("at character 21") && Contains("\"foo\""));
  CHECK_THAT(message("(chain A"), Contains("at character 9: a closing parenthesis is missing"));
  CHECK_THAT(message("chain A)"), Contains("at character 8"));
  CHECK_THAT(message("chain and water"), Contains("at character 7: chain needs a value"));
  CHECK_THAT(message("residue 5x7"), Contains("at character 9") && Contains("\"5x7\""));
  CHECK_THAT(message("residue 9-5"), Contains("ends before it begins"));
  CHECK_THAT(message("name \"CA"), Contains("not closed"));
  CHECK_THAT(message("chain A,"), Contains("missing after the comma"));
  CHECK_THAT(message(std::string(10'000, '(')), Contains("more than 100"));
  std::string negations;
  for (int i = 0; i < 10'000; ++i) negations += "not ";
  CHECK_THAT(message(negations), Contains("more than 100"));
  CHECK(message(std::string(100, '(') + "all" + std::string(100, ')')).empty());
  MoleculeOptions options;
  options.select = "chain";
  CHECK_THROWS_AS(read(pdb_text(small_protein()), ".pdb", options), core::InvalidArgument);
}

namespace {

/// A chain of glycines of which some have their hydrogens.
std::string glycines(int count, int with_hydrogens) {
  std::vector<AtomLine> atoms;
  for (int i = 0; i < count; ++i) {
    const double x = 4.0 * i;
    atoms.push_back({"N", "GLY", "A", i + 1, {x, 0, 0}, "N"});
    atoms.push_back({"CA", "GLY", "A", i + 1, {x + 1, 0, 0}, "C"});
    atoms.push_back({"C", "GLY", "A", i + 1, {x + 2, 0, 0}, "C"});
    if (i < with_hydrogens) atoms.push_back({"HA2", "GLY", "A", i + 1, {x, 1, 0}, "H"});
  }
  atoms.push_back({"C1", "LIG", "A", 900, {0, 9, 0}, "C", false});
  return pdb_text(atoms);
}

}  // namespace

TEST_CASE("radii are united-atom where a chain has no hydrogens") {
  MoleculeOptions options;
  const auto radii = [&](const std::string& text) {
    const Molecule molecule = read(text, ".pdb", options);
    CHECK(molecule.atoms.back().radius == 1.7);  // no amino acid's
    const bool united = molecule.radii == core::AtomRadii::united_atom;
    CHECK(molecule.atoms[0].radius == (united ? 1.64 : 1.55));
    CHECK(molecule.atoms[1].radius == (united ? 1.88 : 1.7));
    CHECK(molecule.atoms[2].radius == (united ? 1.61 : 1.7));
    return to_string(molecule.radii);
  };
  CHECK(radii(glycines(10, 0)) == "united-atom");
  CHECK(radii(glycines(9, 0)) == "all-atom");
  CHECK(radii(glycines(10, 5)) == "all-atom");
  CHECK(radii(glycines(10, 4)) == "united-atom");
  options.hydrogens = false;
  CHECK(radii(glycines(10, 10)) == "united-atom");
  options.radii = "all-atom";
  CHECK(radii(glycines(10, 0)) == "all-atom");
  options.radii = "united-atom";
  CHECK(radii(glycines(2, 2)) == "united-atom");
}

TEST_CASE("united-atom radii are those of the residue whose state it is") {
  const auto radius = [](const char* residue, const char* name) {
    core::Atom atom;
    atom.residue = residue;
    atom.name = name;
    atom.polymer = true;
    return core::united_atom_radius(atom);
  };
  CHECK(radius("HSD", "CE1") == 1.76);
  CHECK(radius("CYX", "SG") == 1.77);
  CHECK(radius("NALA", "CB") == 1.88);
  CHECK(radius("TYR", "OH") == 1.46);
  CHECK(radius("DA5", "C1'") == 1.88);
  CHECK(radius("ADE", "C8") == 1.76);
  CHECK(radius("U", "O4*") == 1.46);
  CHECK(radius("MSE", "SE") == 0);
  CHECK(radius("XYZ", "CA") == 0);
}

TEST_CASE("radii are read from a table") {
  const Scratch folder;
  const auto table = [&](const std::string& text) {
    MoleculeOptions options;
    options.radii = folder.file("radii.txt", text).string();
    options.hetero = HeteroAtoms::all;
    return core::read_molecule(folder.file("m.pdb", pdb_text(small_protein())), options);
  };
  const Molecule molecule =
      table("# own\nC 1.9\nCA 2\nGLY CA 2.1  # of glycine\nCa 2.5\n N 1.5\nO 1.4\nH 1\nSe 2.2\n");
  const auto of = [&](std::int64_t serial) {
    for (const core::Atom& atom : molecule.atoms)
      if (atom.serial == serial) return atom.radius;
    return 0.0;
  };
  CHECK(molecule.radii == core::AtomRadii::of_table);
  CHECK(molecule.warnings.empty());
  CHECK(of(1) == 1.5);
  CHECK(of(2) == 2.1);
  CHECK(of(8) == 2);
  CHECK(of(9) == 1.9);
  CHECK(of(12) == 2);  // the calcium is called CA
  CHECK_THAT(table("GLY CA 2\n").warnings.at(0),
             Contains("atom 1 (N of GLY 1, chain A) and 8 more have no radius"));
  CHECK_THROWS_WITH(table("C\n"), Contains("line 1") && Contains("two words"));
  CHECK_THROWS_WITH(table("C 1\nA B C 1\n"), Contains("line 2"));
  CHECK_THROWS_WITH(table("C 0\n"), Contains("above 0"));
  CHECK_THROWS_WITH(table("C nan\n"), Contains("\"nan\""));
  CHECK_THROWS_WITH(table("C 1\nC 2\n"), Contains("line 2") && Contains("given before"));
  CHECK_THROWS_WITH(table("# none\n"), Contains("has no radii"));

  std::string utf16 = "\xFF\xFE";
  for (const char c : std::string("C 1.9\rN 1.5\rO 1.4\rH 1\rCa 2\rSe 2\r")) utf16 += {c, '\0'};
  const Molecule converted = table(utf16);
  REQUIRE(converted.warnings.size() == 1);
  CHECK_THAT(converted.warnings[0], Contains("it is UTF-16 text"));
  CHECK(converted.atoms[0].radius == 1.5);
  CHECK_THROWS_WITH(table("\x1F\x8B no gzip"), Contains("gzip"));
}

TEST_CASE("PQR files give charges and radii") {
  const std::string text =
      "REMARK   1 PQR file\n"
      "ATOM      1  N   MET A  52A     1.000   2.000   3.000  -0.3000 1.8500\n"
      "ATOM      2  HT1 MET A  52A     2.000   2.000   3.000   0.3300 0.0000\n"
      "HETATM10000 CLA CLA 60 9 0 0 -1 2.27\nEND\n";
  const Molecule molecule = read(text, ".pqr", everything());
  REQUIRE(molecule.atoms.size() == 2);
  CHECK(molecule.radii == core::AtomRadii::of_structure);
  CHECK(molecule.left_out.described() == "1 of radius 0");
  CHECK(molecule.atoms[0].radius == 1.85);
  CHECK(molecule.atoms[0].charge == -0.3);
  CHECK(molecule.atoms[0].sequence_id == "52A");
  CHECK(molecule.atoms[1].chain.empty());
  CHECK(molecule.atoms[1].serial == 10000);
  CHECK(molecule.atoms[1].ion);
  MoleculeOptions all_atom = everything();
  all_atom.radii = "all-atom";
  CHECK(read(text, ".pqr", all_atom).atoms.at(1).radius == 1.2);
  CHECK_FALSE(read(pdb_text({{}}), ".pdb").atoms[0].charge);
  CHECK_THROWS_WITH(read("ATOM 1 N MET 1 0 0 0 -0.3\n", ".pqr"), Contains("line 1") && Contains("10 words"));
  CHECK_THROWS_WITH(read("ATOM 1 N MET 1 0 x 0 -0.3 1\n", ".pqr"),
                    Contains("the coordinate y") && Contains("\"x\""));
  CHECK_THROWS_WITH(read("ATOM 1 N MET 1 0 0 0 -0.3 -1\n", ".pqr"), Contains("negative"));
  CHECK_THROWS_WITH(read("", ".pqr"), Contains("has no atoms"));
}
