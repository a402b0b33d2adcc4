#include "morsel/core/io/atom_roles.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "morsel/core/io/gemmi_bridge.h"
#include "morsel/core/io/residue_names.h"

namespace morsel::core {
namespace {

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// What the name of a residue says, whatever its atoms.
struct NamedResidue {
  gemmi_bridge::Residue tabulated;
  SimulationName simulation;
  std::string ion;  ///< the element, if an atom of that name is one
};

NamedResidue find_name(const std::string& residue) {
  const std::string name = in_capitals(residue);
  NamedResidue found{gemmi_bridge::find_residue(name), find_simulation_name(name), ion_of_simulation(name)};
  if (found.ion.empty()) found.ion = found.tabulated.ion;
  return found;
}

/// "1HB" → "HB".
std::string_view without_digits(std::string_view name) {
  while (!name.empty() && is_digit(name.front())) name.remove_prefix(1);
  return name;
}

/// Whether water models have a site without mass that is so called.
bool is_massless_site(std::string_view atom) {
  return atom.starts_with('M') || atom == "IW" || atom == "OM" || atom.starts_with("EP") ||
         atom.starts_with("LP");
}

/// Whether a water has atoms so called; sites without mass count.
bool is_of_water(std::string_view atom) {
  atom = without_digits(atom);
  if (atom.empty()) return false;
  if (atom[0] == 'H' || atom[0] == 'D')
    return atom.size() == 1 || is_digit(atom[1]) || atom[1] == 'W' || atom[1] == 'H' || atom[1] == 'O';
  if (atom[0] == 'O')
    return atom.size() == 1 || atom[1] == 'W' || atom[1] == 'H' || atom[1] == 'M' || is_digit(atom[1]);
  return is_massless_site(atom);
}

/// Whether an atom is called as an ion of that residue and element: "CLA", "CL", "CL-", "CL1".
bool is_called_as_ion(std::string_view atom, const std::string& residue, const std::string& element) {
  const std::string name = in_capitals(atom);
  if (name == in_capitals(residue)) return true;
  std::string_view symbol = name;
  while (!symbol.empty() && !is_letter(symbol.back())) symbol.remove_suffix(1);
  return symbol == in_capitals(element);
}

/// The element's symbol that an organic residue's atom is called after, in any case; "X" if there is none.
std::string element_by_letters(std::string_view name) {
  name = without_digits(name);
  std::string_view letters = name.substr(0, 2);
  while (!letters.empty() && !is_letter(letters.back())) letters.remove_suffix(1);
  if (letters.empty()) return "X";
  const std::string symbol = in_capitals(letters);
  if (symbol.size() == 2) {
    // In the case of a symbol, or not to be read as the names of carbon, nitrogen, … of some position are.
    constexpr std::string_view kClear[] = {"CL", "BR", "SE", "SI", "FE", "ZN", "MG", "MN", "CU"};
    const bool cased = letters[0] == symbol[0] && letters[1] != symbol[1];
    if (cased || std::find(std::begin(kClear), std::end(kClear), symbol) != std::end(kClear))
      if (const gemmi_bridge::Element found = gemmi_bridge::find_element(symbol); found.symbol != "X")
        return found.symbol;
  }
  constexpr std::string_view kOrganic = "HDCNOSPFBIK";
  if (kOrganic.find(symbol[0]) != std::string_view::npos) return symbol.substr(0, 1);
  return gemmi_bridge::find_element(symbol).symbol;
}

/// The same for an atom of an amino acid or nucleotide, where CA, CD, HG, NE and so on are positions.
std::string element_of_polymer(std::string_view name) {
  name = without_digits(name);
  if (name.empty()) return "X";
  const std::string letters = in_capitals(name.substr(0, 2));
  if (letters == "SE") return "Se";
  if (letters == "BR") return "Br";
  if (letters == "CL") return "Cl";
  constexpr std::string_view kKnown = "HDCNOSPFBI";
  return kKnown.find(letters[0]) == std::string_view::npos ? "X" : letters.substr(0, 1);
}

/// The atoms of a chain's backbone that a residue has.
struct Backbone {
  bool n = false, ca = false, c = false, sugar_1 = false, sugar_4 = false;
  void see(std::string_view atom) {
    if (atom == "N") n = true;
    if (atom == "CA") ca = true;
    if (atom == "C") c = true;
    if (atom == "C1'" || atom == "C1*") sugar_1 = true;
    if (atom == "C4'" || atom == "C4*") sugar_4 = true;
  }
  bool is_there() const { return (n && ca && c) || (sugar_1 && sugar_4); }
};

class Identification {
 public:
  explicit Identification(AtomRecords& all) : all_(all) {}

  void run() {
    find_alignment();
    std::vector<AtomRecord>& records = all_.records;
    std::size_t kept = 0;
    for (std::size_t first = 0, last = 0; first < records.size(); first = last) {
      while (last < records.size() && is_same_residue(records[last], records[first])) ++last;
      identify({records.data() + first, last - first});
      for (std::size_t i = first; i < last; ++i) {
        if (is_no_atom(records[i])) continue;
        if (kept != i) records[kept] = std::move(records[i]);
        ++kept;
      }
    }
    const std::size_t sites = records.size() - kept;
    records.resize(kept);
    const auto told = [&](std::size_t count, const std::string& one, const std::string& many) {
      if (count > 0) all_.warnings.push_back(std::to_string(count) + (count == 1 ? one : many));
    };
    told(sites, " site of a water model or lone pair, which is no atom, is left out",
         " sites of water models and lone pairs, which are no atoms, are left out");
    told(contradictions_, " atom has an element that its name and residue exclude: " + example_,
         " atoms have elements that their names and residues exclude: " + example_ + ", the first of them");
  }

 private:
  static bool is_same_residue(const AtomRecord& a, const AtomRecord& b) {
    return a.atom.sequence_id == b.atom.sequence_id && a.atom.residue == b.atom.residue &&
           a.atom.chain == b.atom.chain && a.in_sequence == b.in_sequence;
  }
  /// A site of a water model or a lone pair.
  static bool is_no_atom(const AtomRecord& record) {
    const bool lone_pair = record.symbol.empty() && record.atom.name.starts_with("LP");
    return record.atom.element == "X" && (record.atom.water || lone_pair);
  }

  const NamedResidue& named(const std::string& residue) {
    const auto [place, is_new] = names_.try_emplace(residue);
    if (is_new) place->second = find_name(residue);
    return place->second;
  }

  static bool is_chain_name(const NamedResidue& name) {
    return name.tabulated.amino_acid || name.tabulated.nucleotide ||
           name.simulation.residue_class == ResidueClass::amino_acid ||
           name.simulation.residue_class == ResidueClass::nucleotide;
  }

  /// Some programs write names from column 13 on, so that columns tell nothing about elements: seen at "CA  "
  /// or "N   " of a polymer.
  void find_alignment() {
    for (const AtomRecord& record : all_.records) {
      const std::array<char, 4>& columns = record.columns;
      if (!is_letter(columns[0]) || columns[3] != ' ') continue;
      if (!is_chain_name(named(record.atom.residue))) continue;
      if (element_of_polymer(record.atom.name).size() != 1) continue;
      is_aligned_ = false;
      return;
    }
  }

  void identify(std::span<AtomRecord> residue) {
    const NamedResidue& name = named(residue[0].atom.residue);
    const bool hetero = residue[0].atom.hetero;
    const ResidueClass simulated = name.simulation.residue_class;
    Backbone backbone;
    bool all_of_water = true;
    for (const AtomRecord& record : residue) {
      backbone.see(record.atom.name);
      all_of_water = all_of_water && is_of_water(in_capitals(record.atom.name));
    }
    const bool in_sequence = residue[0].in_sequence;
    const bool water =
        !in_sequence && (name.tabulated.water || (simulated == ResidueClass::water && all_of_water));
    const bool simulated_chain = (simulated == ResidueClass::amino_acid ||
                                  simulated == ResidueClass::nucleotide || simulated == ResidueClass::cap) &&
                                 (!hetero || backbone.is_there());
    const bool chain_name = name.tabulated.amino_acid || name.tabulated.nucleotide || simulated_chain;
    const bool polymer =
        !water && (in_sequence || chain_name || (!hetero && !name.tabulated.known && backbone.is_there()));
    const bool lipid = simulated == ResidueClass::lipid && !backbone.is_there();
    for (AtomRecord& record : residue) {
      Atom& atom = record.atom;
      atom.water = water;
      atom.ion =
          !water && !in_sequence && !name.ion.empty() && is_called_as_ion(atom.name, atom.residue, name.ion);
      atom.polymer = polymer && !atom.ion;
      record.stays_out = atom.ion || (!atom.polymer && !water && (name.tabulated.known || lipid));
      set_element(record, name, chain_name && !atom.ion);
    }
  }

  void set_element(AtomRecord& record, const NamedResidue& name, bool of_chain) {
    const Atom& atom = record.atom;
    std::string by_name;  // empty: the names do not tell
    if (atom.ion) {
      by_name = name.ion;
    } else if (atom.water) {
      const std::string letters = in_capitals(without_digits(atom.name));
      if (is_massless_site(letters))
        by_name = "X";
      else if (letters.starts_with('H') || letters.starts_with('D') || letters.starts_with('O'))
        by_name = letters.substr(0, 1);
    } else if (of_chain) {
      by_name = element_of_polymer(atom.name);
      if (by_name == "X") by_name.clear();
    }
    gemmi_bridge::Element element;
    if (!record.symbol.empty()) {
      element = gemmi_bridge::find_element(record.symbol);
      if (!by_name.empty() && is_excluded(element, by_name, atom)) {
        if (!(atom.water && by_name == "X") && contradictions_++ == 0)
          example_ = atom.described() + " is taken as " + by_name + ", not " + record.symbol;
        element = gemmi_bridge::find_element(by_name);
      }
    } else {
      if (by_name.empty()) by_name = of_other(record);
      element = gemmi_bridge::find_element(by_name);
    }
    record.atom.element = std::move(element.symbol);
    record.atom.radius = element.radius;
    record.atom.hydrogen = element.hydrogen;
  }

  /// Of chains and waters gemmi's element stays, but for one that cannot be there: a symbol that is none, or
  /// the metal (CA, CD, HG, NE …) that is spelt as the name of a position.
  static bool is_excluded(const gemmi_bridge::Element& element, const std::string& by_name,
                          const Atom& atom) {
    if (element.symbol == by_name) return false;
    if (element.symbol == "X") return true;
    if (atom.ion || atom.water) return !(element.hydrogen && (by_name == "H" || by_name == "D"));
    if (element.symbol.size() != 2 || element.symbol == "Se" || by_name.size() != 1) return false;
    return in_capitals(element.symbol) == in_capitals(without_digits(atom.name).substr(0, 2));
  }

  std::string of_other(const AtomRecord& record) const {
    const std::array<char, 4>& columns = record.columns;
    const bool has_columns = columns[0] != '\0' && is_aligned_;
    // Four characters fill the columns, aligned or not: "HB12", "CL12", "CAB1".
    if (!has_columns || (is_letter(columns[0]) && columns[3] != ' '))
      return element_by_letters(record.atom.name);
    return gemmi_bridge::element_by_columns(columns);
  }

  AtomRecords& all_;
  std::unordered_map<std::string, NamedResidue> names_;
  bool is_aligned_ = true;
  std::size_t contradictions_ = 0;
  std::string example_;
};

}  // namespace

void identify_atoms(AtomRecords& all) { Identification(all).run(); }

}  // namespace morsel::core
