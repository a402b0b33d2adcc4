#include "morsel/core/io/molecule.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_radii.h"
#include "morsel/core/io/atom_records.h"
#include "morsel/core/io/atom_selection.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr std::array<const char*, 3> kHeteroNames = {"none", "residues", "all"};

/// Radii that are no path.
constexpr std::array<const char*, 3> kRadii = {"auto", "all-atom", "united-atom"};

struct NamedFormat {
  std::string_view extension;
  MoleculeFormat format;
};
constexpr auto kMoleculeFormats = std::to_array<NamedFormat>({{".pdb", MoleculeFormat::pdb},
                                                              {".ent", MoleculeFormat::pdb},
                                                              {".cif", MoleculeFormat::mmcif},
                                                              {".mmcif", MoleculeFormat::mmcif},
                                                              {".pqr", MoleculeFormat::pqr}});

std::string_view format_name_of(MoleculeFormat format) {
  switch (format) {
    case MoleculeFormat::pdb:
      return "pdb";
    case MoleculeFormat::mmcif:
      return "mmcif";
    case MoleculeFormat::pqr:
      break;
  }
  return "pqr";
}

std::optional<MoleculeFormat> format_of_name(const std::filesystem::path& path) {
  const std::string extension = content_extension(path);
  const auto* found = std::ranges::find(kMoleculeFormats, extension, &NamedFormat::extension);
  if (found == kMoleculeFormats.end()) return {};
  return found->format;
}

AtomRecords read_records(std::string_view content, MoleculeFormat format, const std::string& name,
                         std::int64_t model, const Progress& progress) {
  const auto read = [&] {
    switch (format) {
      case MoleculeFormat::pdb:
        return read_pdb(content, name, progress, model);
      case MoleculeFormat::mmcif:
        return read_mmcif(content, name, progress, model);
      case MoleculeFormat::pqr:
        break;
    }
    return read_pqr(content, name, progress);
  };
  const std::string_view kind = file_kind(content);
  // PQR files begin as PDB files do.
  const std::string_view own = format == MoleculeFormat::mmcif ? "a CIF file" : "a PDB file";
  const bool other = !kind.empty() && kind != own;
  const std::string what = "it is " + std::string(kind) + ", though " +
                           (format_of_name(name) == format
                                ? "read as " + content_extension(name)
                                : "the format that was given is " + std::string(format_name_of(format)));
  AtomRecords all;
  try {
    all = read();
  } catch (const BadInput& error) {
    if (other) throw BadInput(std::string(error.what()) + " (" + what + ")");
    throw;
  }
  if (other && all.records.empty()) fail_reading(name, what);
  return all;
}

Molecule molecule_of(const TextContent& content, MoleculeFormat format, const std::string& name,
                     const MoleculeOptions& options, const Progress& progress) {
  AtomRecords records = read_records(content.view(), format, name, options.model, progress);
  records.warnings.insert(records.warnings.begin(), content.warnings().begin(), content.warnings().end());
  Molecule molecule = choose_atoms(std::move(records), name, options);
  progress.update("reading the atoms", 1);
  return molecule;
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

/// `chains` are those of the options, `selection` is null if they have none.
bool is_left_out(const AtomRecord& record, const MoleculeOptions& options,
                 const std::set<std::string_view>& chains, const AtomSelection* selection,
                 AtomsLeftOut& count) {
  const Atom& atom = record.atom;
  const auto left_out = [](std::size_t& counter) {
    ++counter;
    return true;
  };
  if (!chains.empty() && !chains.contains(atom.chain)) return left_out(count.other_chains);
  if (selection != nullptr) {
    if (!selection->takes(atom)) return left_out(count.not_selected);
  } else {
    if (atom.water && !options.waters) return left_out(count.waters);
    if (!atom.water && options.hetero != HeteroAtoms::all) {
      const bool hetero = atom.hetero && (options.hetero == HeteroAtoms::none || !atom.polymer);
      if (hetero || record.stays_out) return left_out(count.hetero);
    }
  }
  if (atom.hydrogen && !options.hydrogens) return left_out(count.hydrogens);
  if (record.own_radius == 0 && options.radii == kRadii[0]) return left_out(count.without_radius);
  return false;
}

/// The letter to take of a residue's alternate locations, 0 if there are none.
char chosen_letter(const std::vector<AtomRecord>& records, std::size_t first, std::size_t last,
                   bool highest) {
  struct Letter {
    char name;
    double occupancy = 0;
    std::size_t count = 0;
    double mean() const { return occupancy / static_cast<double>(count); }
  };
  std::vector<Letter> letters;  // in the order of the file
  for (std::size_t i = first; i < last; ++i) {
    const Atom& atom = records[i].atom;
    if (atom.alternate == 0) continue;
    auto letter = std::find_if(letters.begin(), letters.end(),
                               [&](const Letter& l) { return l.name == atom.alternate; });
    if (letter == letters.end()) letter = letters.insert(letter, {atom.alternate});
    letter->occupancy += atom.occupancy;
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
void choose_alternates(std::vector<AtomRecord>& records, const std::string& rule, AtomsLeftOut& count) {
  if (rule == "all") return;
  std::size_t kept = 0;
  for (std::size_t first = 0, last = 0; first < records.size(); first = last) {
    const Atom& atom = records[first].atom;
    while (last < records.size() && records[last].atom.chain == atom.chain &&
           records[last].atom.sequence_id == atom.sequence_id)
      ++last;
    const char letter = rule.size() == 1 ? rule[0] : chosen_letter(records, first, last, rule == "highest");
    for (std::size_t i = first; i < last; ++i) {
      if (records[i].atom.alternate != 0 && records[i].atom.alternate != letter) {
        ++count.alternates;
        continue;
      }
      if (kept != i) records[kept] = std::move(records[i]);
      ++kept;
    }
  }
  records.resize(kept);
}

void check_options(const MoleculeOptions& options) {
  if (options.model < 1)
    throw InvalidArgument("models are counted from 1, not " + std::to_string(options.model));
  const std::string& rule = options.alternate;
  if (rule != "highest" && rule != "first" && rule != "all" && rule.size() != 1)
    throw InvalidArgument("alternate locations are highest, first, all or one letter, not " + shown(rule));
  if (!options.select.empty()) AtomSelection(std::string_view(options.select));
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
  add(not_selected, "not selected");
  add(without_radius, "of radius 0");
  return text;
}

std::vector<std::string> molecule_format_names() {
  std::vector<std::string> names;
  for (const MoleculeFormat format : {MoleculeFormat::pdb, MoleculeFormat::mmcif, MoleculeFormat::pqr})
    names.emplace_back(format_name_of(format));
  return names;
}

MoleculeFormat molecule_format_named(std::string_view name) {
  for (const MoleculeFormat format : {MoleculeFormat::pdb, MoleculeFormat::mmcif, MoleculeFormat::pqr})
    if (format_name_of(format) == name) return format;
  throw InvalidArgument("there is no format " + shown(name) + " of molecules, only " +
                        listed(molecule_format_names(), " and "));
}

Molecule read_molecule(const std::filesystem::path& path, const MoleculeOptions& options,
                       const Progress& progress) {
  require_molecules("reading atoms");
  check_options(options);
  const std::string name = path.string();
  const TextContent content(path, name, progress);  // a missing file is told as such, whatever its extension
  if (const std::optional<MoleculeFormat> format = format_of_name(path))
    return molecule_of(content, *format, name, options, progress);
  const std::string extension = content_extension(path);
  fail_reading(name, "molecules are read from .pdb, .ent, .cif, .mmcif and .pqr files, not " +
                         (extension.empty() ? "from one without an extension" : "from " + extension));
}

Molecule read_molecule(const std::filesystem::path& path, MoleculeFormat format,
                       const MoleculeOptions& options, const Progress& progress) {
  require_molecules("reading atoms");
  check_options(options);
  const std::string name = path.string();
  return molecule_of(TextContent(path, name, progress), format, name, options, progress);
}

Molecule parse_molecule(std::string_view bytes, MoleculeFormat format, const std::string& name,
                        const MoleculeOptions& options, const Progress& progress) {
  require_molecules("reading atoms");
  check_options(options);
  return molecule_of(TextContent(bytes, name, progress), format, name, options, progress);
}

Molecule choose_atoms(AtomRecords all, const std::string& file, const MoleculeOptions& options) {
  check_options(options);
  if (all.models == 0) throw BadInput(file + " has no atoms");
  if (options.model > all.models)
    throw BadInput(file + " has no model " + std::to_string(options.model) + ", it has " +
                   (all.models == 1 ? "only one" : std::to_string(all.models)));
  check_chains(all.records, options.chains, file);

  Molecule molecule;
  molecule.models = all.models;
  molecule.warnings = std::move(all.warnings);
  molecule.atoms_in_model = all.records.size();
  std::optional<AtomSelection> selection;
  if (!options.select.empty()) selection.emplace(options.select);
  const std::set<std::string_view> chains(options.chains.begin(), options.chains.end());
  std::erase_if(all.records, [&](const AtomRecord& record) {
    return is_left_out(record, options, chains, selection ? &*selection : nullptr, molecule.left_out);
  });
  choose_alternates(all.records, options.alternate, molecule.left_out);
  if (all.records.empty())
    throw BadInput(file + " has no atoms left of " + std::to_string(molecule.atoms_in_model) +
                   (molecule.left_out.total() > 0 ? ": the options leave out " + molecule.left_out.described()
                                                  : std::string()));
  molecule.radii = set_radii(all.records, options.radii, file, molecule.warnings);
  molecule.atoms.reserve(all.records.size());
  for (AtomRecord& record : all.records) molecule.atoms.push_back(std::move(record.atom));
  return molecule;
}

std::string to_string(AtomRadii radii) {
  switch (radii) {
    case AtomRadii::all_atom:
      return "all-atom";
    case AtomRadii::united_atom:
      return "united-atom";
    case AtomRadii::of_structure:
      return "of the structure's file";
    case AtomRadii::of_table:
      break;
  }
  return "of a table";
}

MoleculeOptions read_molecule_options(ParameterReader& reader) {
  MoleculeOptions options;
  const std::string hetero =
      reader.choice("hetero", kHeteroNames[static_cast<std::size_t>(options.hetero)],
                    {kHeteroNames.begin(), kHeteroNames.end()},
                    "HETATM atoms and ions: none, those of residues of the chain, or all (ligands, ions)");
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
  options.select =
      reader.text("select", "", "an expression, in place of hetero and waters: chain A and residue 10-20 …");
  options.radii =
      reader.word_or_file("radii", options.radii.c_str(), {kRadii.begin(), kRadii.end()},
                          "radii: all-atom, united-atom, auto (by the hydrogens), or a table's file");
  if (!options.select.empty() && (reader.given("hetero") || reader.given("waters")))
    throw InvalidArgument(
        "an expression to select atoms takes the place of hetero and waters: put them into it, "
        "as in \"polymer or water\"");
  check_options(options);
  return options;
}

Parameters molecule_parameters(const MoleculeOptions& options) {
  std::string chains;
  for (const std::string& chain : options.chains) chains += (chains.empty() ? "" : "/") + escape(chain);
  Parameters parameters;
  if (options.select.empty())
    parameters = {{"hetero", std::string(kHeteroNames[static_cast<std::size_t>(options.hetero)])},
                  {"waters", options.waters}};
  else
    parameters = {{"select", options.select}};
  parameters.emplace_back("hydrogens", options.hydrogens);
  parameters.emplace_back("altloc", options.alternate);
  parameters.emplace_back("chains", chains);
  parameters.emplace_back("model", options.model);
  parameters.emplace_back("radii", options.radii);
  return parameters;
}

}  // namespace morsel::core
