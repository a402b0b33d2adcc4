#include "morsel/core/io/atom_radii.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/residue_names.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// Tsai et al.'s classes: an atom's element, bonds and hydrogens.
constexpr double kC3H0 = 1.61, kC3H1 = 1.76, kC4 = 1.88, kN = 1.64, kO1H0 = 1.42, kO2 = 1.46, kS = 1.77;

struct NamedRadius {
  std::string_view names;  ///< separated and enclosed by blanks
  double radius;
};
struct ResidueRadii {
  std::string_view residue;
  std::vector<NamedRadius> atoms;
};

const std::vector<NamedRadius>& backbone() {
  static const std::vector<NamedRadius> kAtoms = {
      {" N ", kN}, {" CA CB ", kC4}, {" C ", kC3H0}, {" O OXT OT1 OT2 O1 O2 ", kO1H0}};
  return kAtoms;
}

const std::vector<ResidueRadii>& side_chains() {
  static const std::vector<ResidueRadii> kResidues = {
      {"ALA", {}},
      {"ARG", {{" CG CD ", kC4}, {" CZ ", kC3H0}, {" NE NH1 NH2 ", kN}}},
      {"ASN", {{" CG ", kC3H0}, {" OD1 ", kO1H0}, {" ND2 ", kN}}},
      {"ASP", {{" CG ", kC3H0}, {" OD1 OD2 ", kO1H0}}},
      {"CYS", {{" SG ", kS}}},
      {"GLN", {{" CG ", kC4}, {" CD ", kC3H0}, {" OE1 ", kO1H0}, {" NE2 ", kN}}},
      {"GLU", {{" CG ", kC4}, {" CD ", kC3H0}, {" OE1 OE2 ", kO1H0}}},
      {"GLY", {}},
      {"HIS", {{" CG ", kC3H0}, {" CD2 CE1 ", kC3H1}, {" ND1 NE2 ", kN}}},
      {"ILE", {{" CG1 CG2 CD1 CD ", kC4}}},
      {"LEU", {{" CG CD1 CD2 ", kC4}}},
      {"LYS", {{" CG CD CE ", kC4}, {" NZ ", kN}}},
      {"MET", {{" CG CE ", kC4}, {" SD ", kS}}},
      {"MSE", {{" CG CE ", kC4}}},
      {"PHE", {{" CG ", kC3H0}, {" CD1 CD2 CE1 CE2 CZ ", kC3H1}}},
      {"PRO", {{" CG CD ", kC4}}},
      {"SER", {{" OG ", kO2}}},
      {"THR", {{" OG1 ", kO2}, {" CG2 ", kC4}}},
      {"TRP", {{" CG CD2 CE2 ", kC3H0}, {" CD1 CE3 CZ2 CZ3 CH2 ", kC3H1}, {" NE1 ", kN}}},
      {"TYR", {{" CG CZ ", kC3H0}, {" CD1 CD2 CE1 CE2 ", kC3H1}, {" OH ", kO2}}},
      {"VAL", {{" CG1 CG2 ", kC4}}}};
  return kResidues;
}

const std::vector<NamedRadius>& sugar() {
  static const std::vector<NamedRadius> kAtoms = {
      {" C1' C2' C3' C4' C5' ", kC4}, {" O2' O3' O4' O5' ", kO2}, {" OP1 OP2 OP3 O1P O2P O3P ", kO1H0}};
  return kAtoms;
}

const std::vector<ResidueRadii>& bases() {
  static const std::vector<NamedRadius> kAdenine = {
      {" C2 C8 ", kC3H1}, {" C4 C5 C6 ", kC3H0}, {" N1 N3 N6 N7 N9 ", kN}};
  static const std::vector<NamedRadius> kGuanine = {
      {" C8 ", kC3H1}, {" C2 C4 C5 C6 ", kC3H0}, {" N1 N2 N3 N7 N9 ", kN}, {" O6 ", kO1H0}};
  static const std::vector<NamedRadius> kCytosine = {
      {" C5 C6 ", kC3H1}, {" C2 C4 ", kC3H0}, {" N1 N3 N4 ", kN}, {" O2 ", kO1H0}};
  static const std::vector<NamedRadius> kUracil = {
      {" C5 C6 ", kC3H1}, {" C2 C4 ", kC3H0}, {" N1 N3 ", kN}, {" O2 O4 ", kO1H0}};
  static const std::vector<NamedRadius> kThymine = {
      {" C6 ", kC3H1}, {" C2 C4 C5 ", kC3H0}, {" C7 C5M ", kC4}, {" N1 N3 ", kN}, {" O2 O4 ", kO1H0}};
  static const std::vector<ResidueRadii> kResidues = {{"A", kAdenine},  {"DA", kAdenine}, {"G", kGuanine},
                                                      {"DG", kGuanine}, {"C", kCytosine}, {"DC", kCytosine},
                                                      {"U", kUracil},   {"DU", kUracil},  {"DT", kThymine}};
  return kResidues;
}

double find_radius(const std::vector<NamedRadius>& atoms, const std::string& name) {
  const std::string word = " " + name + " ";
  for (const NamedRadius& some : atoms)
    if (some.names.find(word) != std::string_view::npos) return some.radius;
  return 0;
}

const std::vector<NamedRadius>* find_residue_radii(const std::vector<ResidueRadii>& residues,
                                                   std::string_view name) {
  for (const ResidueRadii& residue : residues)
    if (residue.residue == name) return &residue.atoms;
  return nullptr;
}

/// The residue of the PDB that one of simulations is.
std::string parent_of(const std::string& residue) {
  const std::string name = in_capitals(residue);
  const SimulationName simulated = find_simulation_name(name);
  return simulated.parent.empty() ? name : std::string(simulated.parent);
}

/// A file's lines: an atom's name or an element, and its radius, with the name of a residue before them or
/// not.
class RadiusTable {
 public:
  RadiusTable(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    const std::string file = path.string();
    const TextContent content(path, file);
    for (const std::string& warning : content.warnings()) warnings.push_back(shown(file) + ": " + warning);
    TextScanner text(content.view(), file, {.comment = '#'}, {});
    while (text.next_line()) {
      std::vector<std::string_view> words;
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        words.push_back(word);
        if (words.size() > 3) break;
      }
      if (words.size() != 2 && words.size() != 3)
        text.fail(
            "a radius has a line of two words (atom or element, radius in Å) or three (with the residue "
            "before them), not " +
            (words.size() > 3 ? std::string("of more") : std::to_string(words.size())));
      const double radius = number(text, words.back());
      std::string residue = words.size() == 3 ? in_capitals(words[0]) : std::string();
      const bool is_new =
          radii_.emplace(std::pair(std::move(residue), std::string(words[words.size() - 2])), radius).second;
      if (!is_new) text.fail("the radius of this atom was given before");
    }
    if (radii_.empty()) throw BadInput(file + " has no radii");
  }

  /// 0 if there is none.
  double find(const Atom& atom) const {
    const std::string residue = in_capitals(atom.residue);
    // A symbol of two letters is spelt as one ("Ca"): "CA" is the name of an atom.
    for (const std::string& of : {residue, std::string()})
      for (const std::string* name : {&atom.name, &atom.element})
        if (const auto found = radii_.find({of, *name}); found != radii_.end()) return found->second;
    return 0;
  }

 private:
  static double number(const TextScanner& text, std::string_view word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !(value > 0 && value <= 100))
      text.fail("a radius must be a number above 0 and at most 100 Å, not " + shown(word));
    return value;
  }

  std::map<std::pair<std::string, std::string>, double> radii_;
};

/// How many of the chains' residues there are, and how many of them have the hydrogens that every amino acid
/// and nucleotide has at a carbon of its backbone.
struct ChainResidues {
  std::size_t all = 0;
  std::size_t with_hydrogens = 0;
};
ChainResidues count_residues(std::span<const AtomRecord> atoms) {
  ChainResidues count;
  const Atom* last = nullptr;
  bool has = false;
  for (const AtomRecord& record : atoms) {
    const Atom& atom = record.atom;
    if (!atom.polymer) continue;
    if (last == nullptr || atom.sequence_id != last->sequence_id || atom.residue != last->residue ||
        atom.chain != last->chain) {
      ++count.all;
      has = false;
    }
    last = &atom;
    if (has || !atom.hydrogen) continue;
    std::string_view name = atom.name;
    while (!name.empty() && name[0] >= '0' && name[0] <= '9') name.remove_prefix(1);
    if (name.size() < 2 || (name[1] != 'A' && name.find_first_of("'*") == std::string_view::npos)) continue;
    has = true;
    ++count.with_hydrogens;
  }
  return count;
}

/// In smaller pieces hydrogens may be missing for other reasons than that nobody could see them.
constexpr std::size_t kFewestResidues = 10;

bool lacks_hydrogens(std::span<const AtomRecord> atoms) {
  const ChainResidues residues = count_residues(atoms);
  return residues.all >= kFewestResidues && 2 * residues.with_hydrogens < residues.all;
}

void require_elements(std::span<const AtomRecord> atoms, const std::string& file) {
  const auto unknown = [](const AtomRecord& record) { return !(record.atom.radius > 0); };
  const auto first = std::find_if(atoms.begin(), atoms.end(), unknown);
  if (first == atoms.end()) return;
  const auto count = std::count_if(first, atoms.end(), unknown);
  throw BadInput(file + ": " + first->atom.described() + " is of no known element" +
                 (count > 1 ? ", the first of " + std::to_string(count) : std::string()) +
                 ", so it has no van der Waals radius");
}

}  // namespace

double united_atom_radius(const Atom& atom) {
  if (!atom.polymer || atom.hydrogen) return 0;
  const std::string residue = parent_of(atom.residue);
  std::string name = in_capitals(atom.name);
  if (const auto* side_chain = find_residue_radii(side_chains(), residue)) {
    const double radius = find_radius(backbone(), name);
    return radius > 0 ? radius : find_radius(*side_chain, name);
  }
  std::replace(name.begin(), name.end(), '*', '\'');
  if (const auto* base = find_residue_radii(bases(), residue)) {
    const double radius = find_radius(sugar(), name);
    return radius > 0 ? radius : find_radius(*base, name);
  }
  return 0;
}

AtomRadii set_radii(std::span<AtomRecord> atoms, const std::string& radii, const std::string& file,
                    std::vector<std::string>& warnings) {
  const bool has_own = std::any_of(atoms.begin(), atoms.end(),
                                   [](const AtomRecord& record) { return record.own_radius >= 0; });
  if (radii == "auto" && has_own) {
    for (AtomRecord& record : atoms) record.atom.radius = record.own_radius;
    return AtomRadii::of_structure;
  }
  if (radii == "auto" || radii == "all-atom" || radii == "united-atom") {
    require_elements(atoms, file);
    if (radii == "all-atom" || (radii == "auto" && !lacks_hydrogens(atoms))) return AtomRadii::all_atom;
    for (AtomRecord& record : atoms)
      if (const double radius = united_atom_radius(record.atom); radius > 0) record.atom.radius = radius;
    return AtomRadii::united_atom;
  }
  const RadiusTable table(radii, warnings);
  const Atom* first = nullptr;
  std::size_t missing = 0;
  for (AtomRecord& record : atoms) {
    if (const double radius = table.find(record.atom); radius > 0)
      record.atom.radius = radius;
    else if (missing++ == 0)
      first = &record.atom;
  }
  require_elements(atoms, file);
  if (missing > 0)
    warnings.push_back(first->described() +
                       (missing > 1 ? " and " + std::to_string(missing - 1) + " more" : "") +
                       (missing > 1 ? " have" : " has") + " no radius in " + shown(radii) +
                       ", but the van der Waals radius of the element");
  return AtomRadii::of_table;
}

}  // namespace morsel::core
