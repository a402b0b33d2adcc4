#include "morsel/core/io/molecule.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_records.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr std::array<const char*, 3> kHeteroNames = {"none", "residues", "all"};

AtomRecords read_records(const std::filesystem::path& path, const Progress& progress) {
  const std::string name = path.string();
  const TextContent content(path, name, progress);
  const std::string extension = content_extension(path);
  const bool pdb = extension == ".pdb" || extension == ".ent";
  if (!pdb && extension != ".cif" && extension != ".mmcif")
    fail_reading(name, "molecules are read from .pdb, .ent, .cif and .mmcif files, not " +
                           (extension.empty() ? "from one without an extension" : "from " + extension));
  const std::string_view kind = file_kind(content.view());
  const bool other = !kind.empty() && kind != (pdb ? "a PDB file" : "a CIF file");
  const std::string read_as = ", though read as " + extension;
  AtomRecords all;
  try {
    all = pdb ? read_pdb(content.view(), name, progress) : read_mmcif(content.view(), name, progress);
  } catch (const BadInput& error) {
    if (other) throw BadInput(std::string(error.what()) + " (it is " + std::string(kind) + read_as + ")");
    throw;
  }
  if (other && all.records.empty()) fail_reading(name, "it is " + std::string(kind) + read_as);
  return all;
}

/// Chains in the order of the file, each once.
std::vector<std::string> chain_names(const std::vector<AtomRecord>& records) {
  std::vector<std::string> names;
  std::set<std::string_view> seen;
  for (const AtomRecord& record : records)
    if (seen.insert(record.atom.chain).second) names.push_back(record.atom.chain);
  return names;
}

void check_chains(const std::vector<AtomRecord>& records, const std::vector<std::string>& wanted,
                  const std::string& file) {
  if (wanted.empty()) return;
  const std::vector<std::string> there = chain_names(records);
  const std::set<std::string_view> known(there.begin(), there.end());
  for (const std::string& name : wanted) {
    if (known.contains(name)) continue;
    std::string message = file + " has no chain " + shown(name) + "; its chains are";
    for (std::size_t i = 0; i < there.size(); ++i)
      message.append(i == 0 ? ": " : ", ").append(shown(there[i]));
    throw BadInput(message);
  }
}

/// `chains` are those of the options.
bool is_left_out(const AtomRecord& record, const MoleculeOptions& options,
                 const std::set<std::string_view>& chains, AtomsLeftOut& count) {
  const Atom& atom = record.atom;
  const auto left_out = [](std::size_t& counter) {
    ++counter;
    return true;
  };
  if (!chains.empty() && !chains.contains(atom.chain)) return left_out(count.other_chains);
  if (atom.water) return options.waters ? false : left_out(count.waters);
  if (atom.hetero &&
      (options.hetero == HeteroAtoms::none || (options.hetero == HeteroAtoms::residues && !atom.polymer)))
    return left_out(count.hetero);
  if (record.hydrogen && !options.hydrogens) return left_out(count.hydrogens);
  return false;
}

/// The letter to take of a residue's alternate locations, 0 if there are none.
char chosen_letter(const std::vector<Atom>& atoms, std::size_t first, std::size_t last, bool highest) {
  struct Letter {
    char name;
    double occupancy = 0;
    std::size_t count = 0;
    double mean() const { return occupancy / static_cast<double>(count); }
  };
  std::vector<Letter> letters;  // in the order of the file
  for (std::size_t i = first; i < last; ++i) {
    if (atoms[i].alternate == 0) continue;
    auto letter = std::find_if(letters.begin(), letters.end(),
                               [&](const Letter& l) { return l.name == atoms[i].alternate; });
    if (letter == letters.end()) letter = letters.insert(letter, {atoms[i].alternate});
    letter->occupancy += atoms[i].occupancy;
    ++letter->count;
  }
  if (letters.empty()) return 0;
  if (!highest) return letters.front().name;
  return std::max_element(letters.begin(), letters.end(),
                          [](const Letter& a, const Letter& b) { return a.mean() < b.mean(); })
      ->name;
}

/// Keeps one location of each residue. Those of one place in the chain belong together, also where the
/// alternatives are different residues.
void choose_alternates(std::vector<Atom>& atoms, const std::string& rule, AtomsLeftOut& count) {
  if (rule == "all") return;
  std::vector<Atom> kept;
  kept.reserve(atoms.size());
  for (std::size_t first = 0, last = 0; first < atoms.size(); first = last) {
    while (last < atoms.size() && atoms[last].chain == atoms[first].chain &&
           atoms[last].sequence_id == atoms[first].sequence_id)
      ++last;
    const char letter = rule.size() == 1 ? rule[0] : chosen_letter(atoms, first, last, rule == "highest");
    for (std::size_t i = first; i < last; ++i)
      if (atoms[i].alternate == 0 || atoms[i].alternate == letter)
        kept.push_back(std::move(atoms[i]));
      else
        ++count.alternates;
  }
  atoms = std::move(kept);
}

void check_options(const MoleculeOptions& options) {
  if (options.model < 1)
    throw InvalidArgument("models are counted from 1, not " + std::to_string(options.model));
  const std::string& rule = options.alternate;
  if (rule != "highest" && rule != "first" && rule != "all" && rule.size() != 1)
    throw InvalidArgument("alternate locations are highest, first, all or one letter, not " + shown(rule));
}

}  // namespace

std::string Atom::described() const {
  return "atom " + std::to_string(serial) + " (" + name + " of " + residue +
         (sequence_id.empty() ? "" : " " + sequence_id) + (chain.empty() ? "" : ", chain " + chain) + ")";
}

std::string AtomsLeftOut::described() const {
  std::string text;
  const auto add = [&](std::size_t n, const char* what) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + what;
  };
  add(other_chains, "of other chains");
  add(waters, "of waters");
  add(hetero, "hetero");
  add(hydrogens, "hydrogens");
  add(alternates, "at other alternate locations");
  return text;
}

Molecule read_molecule(const std::filesystem::path& path, const MoleculeOptions& options,
                       const Progress& progress) {
  require_molecules("reading atoms");
  check_options(options);
  Molecule molecule = choose_atoms(read_records(path, progress), path.string(), options);
  progress.update("reading the atoms", 1);
  return molecule;
}

Molecule choose_atoms(AtomRecords all, const std::string& file, const MoleculeOptions& options) {
  check_options(options);
  if (all.records.empty()) throw BadInput(file + " has no atoms");
  if (options.model > all.models)
    throw BadInput(file + " has no model " + std::to_string(options.model) + ", it has " +
                   (all.models == 1 ? "only one" : std::to_string(all.models)));
  std::erase_if(all.records, [&](const AtomRecord& record) { return record.model != options.model; });
  check_chains(all.records, options.chains, file);

  Molecule molecule;
  molecule.models = all.models;
  molecule.atoms_in_model = all.records.size();
  const std::set<std::string_view> chains(options.chains.begin(), options.chains.end());
  for (AtomRecord& record : all.records)
    if (!is_left_out(record, options, chains, molecule.left_out))
      molecule.atoms.push_back(std::move(record.atom));
  choose_alternates(molecule.atoms, options.alternate, molecule.left_out);
  if (molecule.atoms.empty())
    throw BadInput(file + " has no atoms left of " + std::to_string(molecule.atoms_in_model) +
                   ": the options leave out " + molecule.left_out.described());
  const auto unknown = [](const Atom& atom) { return !(atom.radius > 0); };
  if (const auto first = std::find_if(molecule.atoms.begin(), molecule.atoms.end(), unknown);
      first != molecule.atoms.end()) {
    const auto count = std::count_if(first, molecule.atoms.end(), unknown);
    throw BadInput(file + ": " + first->described() + " is of no known element" +
                   (count > 1 ? ", the first of " + std::to_string(count) : std::string()) +
                   ", so it has no van der Waals radius");
  }
  return molecule;
}

MoleculeOptions read_molecule_options(ParameterReader& reader) {
  MoleculeOptions options;
  const std::string hetero =
      reader.choice("hetero", kHeteroNames[static_cast<std::size_t>(options.hetero)],
                    {kHeteroNames.begin(), kHeteroNames.end()},
                    "HETATM atoms: none, those of modified residues of the chain, or all (ligands, ions)");
  options.hetero = static_cast<HeteroAtoms>(std::find(kHeteroNames.begin(), kHeteroNames.end(), hetero) -
                                            kHeteroNames.begin());
  options.waters = reader.flag("waters", options.waters, "the waters, too");
  options.hydrogens = reader.flag("hydrogens", options.hydrogens, "the hydrogens that the file has");
  options.alternate = reader.text("altloc", options.alternate.c_str(),
                                  "alternate locations: highest (occupancy), first, all, or a letter");
  options.chains = reader.list("chains", "", "the chains to take, as in A/B; by default all");
  std::erase(options.chains, "");
  options.model =
      reader.count("model", options.model, 1, 1'000'000'000, "which model of the file, counted from 1");
  check_options(options);
  return options;
}

Parameters molecule_parameters(const MoleculeOptions& options) {
  std::string chains;
  for (const std::string& chain : options.chains) chains += (chains.empty() ? "" : "/") + escape(chain);
  return {{"hetero", std::string(kHeteroNames[static_cast<std::size_t>(options.hetero)])},
          {"waters", options.waters},
          {"hydrogens", options.hydrogens},
          {"altloc", options.alternate},
          {"chains", chains},
          {"model", options.model}};
}

}  // namespace morsel::core
