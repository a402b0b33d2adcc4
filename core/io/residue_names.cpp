#include "morsel/core/io/residue_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace morsel::core {
namespace {

using Names = std::unordered_map<std::string, SimulationName>;

/// Protonation states, cysteines in bridges and the like.
constexpr std::pair<const char*, const char*> kAminoAcids[] = {
    {"HSD", "HIS"},  {"HSE", "HIS"},  {"HSP", "HIS"},  {"HID", "HIS"},  {"HIE", "HIS"},  {"HIP", "HIS"},
    {"HISA", "HIS"}, {"HISB", "HIS"}, {"HISD", "HIS"}, {"HISE", "HIS"}, {"HISH", "HIS"}, {"HISP", "HIS"},
    {"HIS1", "HIS"}, {"HIS2", "HIS"}, {"CYX", "CYS"},  {"CYM", "CYS"},  {"CYS1", "CYS"}, {"CYS2", "CYS"},
    {"CYSH", "CYS"}, {"ASH", "ASP"},  {"ASPH", "ASP"}, {"ASPP", "ASP"}, {"ASPR", "ASP"}, {"GLH", "GLU"},
    {"GLUH", "GLU"}, {"GLUP", "GLU"}, {"LYN", "LYS"},  {"LYP", "LYS"},  {"LYSH", "LYS"}, {"LSN", "LYS"},
    {"LYSN", "LYS"}, {"ARGN", "ARG"}, {"ARN", "ARG"},  {"TYM", "TYR"},  {"TYRU", "TYR"}, {"SERD", "SER"},
    {"GLYP", "GLY"}, {"PROP", "PRO"}};

/// Residues that AMBER prefixes with the end of the chain that they are at.
constexpr const char* kAtEnds[] = {"ALA", "ARG", "ASN", "ASP", "CYS", "CYX", "GLN", "GLU",
                                   "GLY", "HID", "HIE", "HIP", "HIS", "ILE", "LEU", "LYS",
                                   "MET", "PHE", "PRO", "SER", "THR", "TRP", "TYR", "VAL"};

constexpr std::pair<const char*, const char*> kNucleotides[] = {
    {"ADE", "A"}, {"GUA", "G"},  {"CYT", "C"},   {"URA", "U"},   {"THY", "DT"}, {"DADE", "DA"},
    {"T", "DT"},  {"RA", "A"},   {"RG", "G"},    {"RC", "C"},    {"RU", "U"},   {"DGUA", "DG"},
    {"T5", "DT"}, {"T3", "DT"},  {"DTHY", "DT"}, {"DCYT", "DC"}, {"RADE", "A"}, {"RGUA", "G"},
    {"TN", "DT"}, {"RCYT", "C"}, {"RURA", "U"}};

/// At the ends of chains and alone: "DA5", "RA3", "A5", "UN".
constexpr const char* kBases[] = {"A", "C", "G", "U", "DA", "DC", "DG", "DT", "RA", "RC", "RG", "RU"};

constexpr const char* kCaps[] = {"ACE", "NME", "NMA", "NAC", "NH2", "NHE", "FOR", "CT3", "CT2"};

/// Without a check of their atoms only those of gemmi (HOH, WAT, H2O, DOD) are waters.
constexpr const char* kWaters[] = {
    "HOH", "WAT",  "H2O", "DOD",  "D2O",  "TIP",  "TIP2", "TIP3", "TIP4", "TIP5",  "TP3",    "TP3M",
    "TP4", "TP4E", "TP5", "TPW",  "T3P",  "T4P",  "T4E",  "T4PE", "T5P",  "TIP3P", "TIP4P",  "TIP5P",
    "SPC", "SPCE", "SPE", "SPCF", "SPF",  "SPCW", "SOL",  "SLV",  "OPC",  "OPC3",  "OPC4",   "OH2",
    "HHO", "OHH",  "SWM", "SWM4", "SWM6", "PL3",  "POL3", "QSPC", "FB3",  "FB4",   "TIP4EW", "T4EW"};

constexpr const char* kLipids[] = {
    "DLPC", "DMPC", "DPPC", "DSPC", "DOPC", "DAPC", "POPC", "PLPC", "SOPC", "DLPE", "DMPE", "DPPE",
    "DSPE", "DOPE", "POPE", "PLPE", "SOPE", "DLPS", "DMPS", "DPPS", "DOPS", "POPS", "PLPS", "SOPS",
    "DLPG", "DMPG", "DPPG", "DOPG", "POPG", "PLPG", "SOPG", "DLPA", "DMPA", "DPPA", "DOPA", "POPA",
    "POPI", "SAPI", "TOCL", "PSM",  "SSM",  "CHL1", "CHOL", "DLP",  "DPP",  "POP",  "DOP",  "DMP"};

/// CHARMM's, AMBER's and older names; of the PDB's own gemmi knows which are ions.
constexpr std::pair<const char*, const char*> kIons[] = {
    {"SOD", "Na"}, {"CLA", "Cl"}, {"POT", "K"},  {"CAL", "Ca"}, {"CES", "Cs"}, {"LIT", "Li"}, {"RUB", "Rb"},
    {"BAR", "Ba"}, {"CAD", "Cd"}, {"CIO", "Cs"}, {"CIM", "Cl"}, {"CIP", "Na"}, {"IM", "Cl"},  {"IP", "Na"},
    {"IOD", "I"},  {"BRO", "Br"}, {"FLU", "F"},  {"ZN2", "Zn"}, {"MG2", "Mg"}, {"CA2", "Ca"}, {"FE2", "Fe"},
    {"FE3", "Fe"}, {"CU1", "Cu"}, {"CU2", "Cu"}, {"SR2", "Sr"}, {"BA2", "Ba"}, {"CD2", "Cd"}, {"MN2", "Mn"},
    {"CO2", "Co"}, {"NI2", "Ni"}, {"NA", "Na"},  {"CL", "Cl"},  {"LI", "Li"},  {"RB", "Rb"},  {"CS", "Cs"},
    {"BR", "Br"},  {"MG", "Mg"},  {"CA", "Ca"},  {"ZN", "Zn"},  {"MN", "Mn"},  {"FE", "Fe"},  {"CU", "Cu"},
    {"NI", "Ni"},  {"CO", "Co"},  {"CD", "Cd"},  {"HG", "Hg"},  {"SR", "Sr"},  {"BA", "Ba"},  {"AG", "Ag"},
    {"AL", "Al"},  {"PB", "Pb"},  {"PT", "Pt"},  {"AU", "Au"},  {"TL", "Tl"},  {"GA", "Ga"},  {"CR", "Cr"},
    {"V", "V"},    {"YB", "Yb"},  {"GD", "Gd"},  {"LA", "La"},  {"EU", "Eu"},  {"SM", "Sm"},  {"TB", "Tb"},
    {"LU", "Lu"},  {"BE", "Be"},  {"PD", "Pd"},  {"RU", "Ru"},  {"OS", "Os"},  {"IR", "Ir"},  {"RH", "Rh"},
    {"K", "K"},    {"F", "F"},    {"I", "I"},    {"W", "W"},    {"Y", "Y"},    {"U", "U"}};

Names made_names() {
  Names names;
  for (const char* name : kLipids) names[name] = {ResidueClass::lipid};
  for (const char* name : kWaters) names[name] = {ResidueClass::water};
  for (const char* name : kCaps) names[name] = {ResidueClass::cap};
  for (const auto& [name, parent] : kNucleotides) names[name] = {ResidueClass::nucleotide, parent};
  for (const std::string_view base : kBases) {
    const std::string_view parent = base.size() == 2 && base[0] == 'R' ? base.substr(1) : base;
    for (const char end : {'5', '3', 'N'})
      names[std::string(base) + end] = {ResidueClass::nucleotide, parent};
  }
  for (const auto& [name, parent] : kAminoAcids) names[name] = {ResidueClass::amino_acid, parent};
  for (const char* name : kAtEnds) {
    const auto state = names.find(name);
    const std::string_view parent = state == names.end() ? name : state->second.parent;
    for (const char end : {'N', 'C'}) names[end + std::string(name)] = {ResidueClass::amino_acid, parent};
  }
  return names;
}

}  // namespace

std::string in_capitals(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return result;
}

SimulationName find_simulation_name(const std::string& name) {
  static const Names kNames = made_names();
  const auto known = kNames.find(name);
  return known == kNames.end() ? SimulationName{} : known->second;
}

std::string ion_of_simulation(const std::string& name) {
  static const std::unordered_map<std::string, std::string> kElements(std::begin(kIons), std::end(kIons));
  const auto find = [](const std::string& symbol) {
    const auto known = kElements.find(symbol);
    return known == kElements.end() ? std::string() : known->second;
  };
  if (const std::string element = find(name); !element.empty()) return element;
  // "NA+", "MG2+", "CL-", "ZN+2", "CA++".
  std::size_t end = name.size();
  while (end > 0 &&
         (name[end - 1] == '+' || name[end - 1] == '-' || (name[end - 1] >= '0' && name[end - 1] <= '9')))
    --end;
  const bool charged = name.find_first_of("+-", end) != std::string::npos;
  return charged && end > 0 ? find(name.substr(0, end)) : std::string();
}

}  // namespace morsel::core
