#include "morsel/tools/export/residues_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"
#include "morsel/tools/color/surface_colors.h"
#include "morsel/tools/formats/csv.h"

namespace morsel::tools {
namespace {

using core::Atom;
using core::Index;

bool is_plain_word(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  });
}

/// Atoms of one residue, which follow each other in the file.
struct Residue {
  Index first = 0, end = 0;
  /// Whether chain and number are such that a script may hold them, and no other residue has both.
  bool is_named = false;
};

class Residues {
 public:
  explicit Residues(std::span<const Atom> atoms) : of_atom_(atoms.size()) {
    using Key = std::pair<std::string_view, std::string_view>;
    const auto key = [&](Index atom) { return Key{atoms[atom].chain, atoms[atom].sequence_id}; };
    std::map<Key, Index> residues_of;
    std::set<std::pair<std::string_view, char>> names;  // of the residue's atoms
    for (Index i = 0; i < atoms.size(); ++i) {
      const bool is_new_name = names.emplace(atoms[i].name, atoms[i].alternate).second;
      // Readers put the atoms of equal numbers together, so that names tell where the next residue begins.
      if (i == 0 || !is_new_name || key(i) != key(i - 1) || atoms[i].residue != atoms[i - 1].residue) {
        names.clear();
        names.emplace(atoms[i].name, atoms[i].alternate);
        all_.push_back({i, i, is_plain_word(atoms[i].chain) && is_plain_word(atoms[i].sequence_id)});
        ++residues_of[key(i)];
      }
      ++all_.back().end;
      of_atom_[i] = static_cast<Index>(all_.size() - 1);
    }
    for (Residue& residue : all_) residue.is_named &= residues_of[key(residue.first)] == 1;
  }

  const Residue& operator[](Index residue) const { return all_[residue]; }
  Index of_atom(Index atom) const { return of_atom_[atom]; }
  std::size_t count() const { return all_.size(); }

 private:
  std::vector<Residue> all_;
  std::vector<Index> of_atom_;
};

/// The serial numbers of atoms, by which a script names what has no other name.
class Serials {
 public:
  Serials(std::span<const Atom> atoms, const Residues& residues)
      : atoms_(atoms), residues_(residues), by_serial_(atoms.size()), place_(atoms.size()) {
    std::iota(by_serial_.begin(), by_serial_.end(), Index{0});
    std::stable_sort(by_serial_.begin(), by_serial_.end(),
                     [&](Index a, Index b) { return atoms[a].serial < atoms[b].serial; });
    for (Index k = 0; k < by_serial_.size(); ++k) place_[by_serial_[k]] = k;
  }

  using Run = std::pair<std::int64_t, std::int64_t>;
  /// The numbers of the atoms of these residues as runs, ascending, without those of all other atoms. A run
  /// goes over gaps within a residue, as of hydrogens that were not taken, but not over others, as of a
  /// ligand. Throws BadInput if an atom has a negative number, or that of an atom of another residue.
  std::vector<Run> runs(const std::vector<Index>& residues) const {
    std::vector<Index> places;
    for (const Index r : residues)
      for (Index i = residues_[r].first; i < residues_[r].end; ++i) places.push_back(place_[i]);
    std::sort(places.begin(), places.end());
    std::vector<Run> result;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Index place = places[i];
      check(place, i > 0 && places[i - 1] + 1 == place, i + 1 < places.size() && places[i + 1] == place + 1);
      if (i > 0 && goes_on(places[i - 1], place))
        result.back().second = serial(place);
      else
        result.emplace_back(serial(place), serial(place));
    }
    return result;
  }

 private:
  std::int64_t serial(Index place) const { return atoms_[by_serial_[place]].serial; }
  Index residue(Index place) const { return residues_.of_atom(by_serial_[place]); }

  bool goes_on(Index last, Index place) const {
    if (place != last + 1) return false;
    return serial(place) - serial(last) <= 1 || residue(place) == residue(last);
  }
  void check(Index place, bool has_last, bool has_next) const {
    if (serial(place) < 0)
      throw core::BadInput(core::printable(atoms_[by_serial_[place]].described()) +
                           " has a negative serial number, which no script can hold: write the residues as "
                           ".pdb or .csv");
    if (place > 0 && !has_last && serial(place - 1) == serial(place)) fail_shared(place, place - 1);
    if (place + 1 < place_.size() && !has_next && serial(place + 1) == serial(place))
      fail_shared(place, place + 1);
  }
  [[noreturn]] void fail_shared(Index here, Index other) const {
    throw core::BadInput("no script can tell " + core::printable(atoms_[by_serial_[here]].described()) +
                         " from " + core::printable(atoms_[by_serial_[other]].described()) +
                         ", which has the same serial number: write the residues as .pdb or .csv");
  }

  std::span<const Atom> atoms_;
  const Residues& residues_;
  std::vector<Index> by_serial_;
  std::vector<Index> place_;  // of each atom in by_serial_
};

/// For each thing that has parts of its area in several segments, the segment of the largest; kNone without.
template <class Thing>
std::vector<Index> main_segments(std::span<const SegmentAtom> atoms, std::size_t count, const Thing& thing) {
  std::vector<Index> segment(count, core::kNone);
  std::vector<double> largest(count, -1), running(count, 0);
  std::vector<Index> running_segment(count, core::kNone);
  for (const SegmentAtom& part : atoms) {  // by segment
    const Index i = thing(part.atom);
    if (running_segment[i] != part.segment) {
      running_segment[i] = part.segment;
      running[i] = 0;
    }
    running[i] += part.area;
    if (running[i] > largest[i]) {
      largest[i] = running[i];
      segment[i] = part.segment;
    }
  }
  return segment;
}

std::string decimals(double value, const char* pattern) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

/// What the two kinds of scripts have in common.
class Script {
 public:
  Script(std::span<const Atom> atoms, const Residues& residues, const Serials& serials)
      : atoms_(atoms), residues_(residues), serials_(serials) {}
  virtual ~Script() = default;

  void write(core::FileWriter& file, const SegmentedAtoms& level, const std::string& prefix) const {
    const std::vector<Index> main =
        main_segments(level.atoms, residues_.count(), [&](Index atom) { return residues_.of_atom(atom); });
    std::map<Index, std::vector<Index>> coloured;
    for (Index r = 0; r < main.size(); ++r)
      if (main[r] != core::kNone) coloured[main[r]].push_back(r);
    for (std::size_t first = 0, last = 0; first < level.atoms.size(); first = last) {
      const Index segment = level.atoms[first].segment;
      std::vector<Index> found;
      for (; last < level.atoms.size() && level.atoms[last].segment == segment; ++last)
        found.push_back(residues_.of_atom(level.atoms[last].atom));
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      const std::string name = prefix + "segment_" + std::to_string(segment);
      file.write(select(name, found));
      if (const auto own = coloured.find(segment); own != coloured.end())
        file.write(paint(name, own->second, to_bytes(level.palette[segment])));
    }
  }

 protected:
  virtual std::string select(const std::string& name, const std::vector<Index>& residues) const = 0;
  virtual std::string paint(const std::string& name, const std::vector<Index>& residues,
                            const ColorBytes& rgb) const = 0;

  /// The residues chain by chain, those that a script cannot name as numbers of their atoms.
  struct Named {
    std::map<std::string, std::vector<std::string>> of_chain;
    std::vector<Serials::Run> serials;
  };
  Named named(const std::vector<Index>& residues) const {
    Named result;
    std::vector<Index> others;
    for (const Index r : residues) {
      const Atom& atom = atoms_[residues_[r].first];
      if (residues_[r].is_named)
        result.of_chain[atom.chain].push_back(atom.sequence_id);
      else
        others.push_back(r);
    }
    result.serials = serials_.runs(others);
    return result;
  }
  static std::string joined(const std::vector<std::string>& words, const char* separator) {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : separator).append(word);
    return text;
  }

 private:
  std::span<const Atom> atoms_;
  const Residues& residues_;
  const Serials& serials_;
};

class PymolScript final : public Script {
 public:
  using Script::Script;

 protected:
  std::string select(const std::string& name, const std::vector<Index>& residues) const override {
    return "select " + name + ", " + selection(residues) + "\n";
  }
  std::string paint(const std::string& name, const std::vector<Index>& residues,
                    const ColorBytes& rgb) const override {
    std::string text = "set_color " + name + "_color, [";
    for (std::size_t i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + decimals(rgb[i] / 255.0, "%.3f");
    return text + "]\ncolor " + name + "_color, " + selection(residues) + "\n";
  }

 private:
  std::string selection(const std::vector<Index>& residues) const {
    const Named parts = named(residues);
    std::vector<std::string> terms;
    for (const auto& [chain, numbers] : parts.of_chain)
      terms.push_back("(chain " + chain + " and resi " + joined(numbers, "+") + ")");
    std::vector<std::string> runs;
    for (const auto& [first, last] : parts.serials)
      runs.push_back(std::to_string(first) + (first < last ? "-" + std::to_string(last) : ""));
    if (!runs.empty()) terms.push_back("(id " + joined(runs, "+") + ")");
    return joined(terms, " or ");
  }
};

class ChimeraxScript final : public Script {
 public:
  using Script::Script;

 protected:
  std::string select(const std::string& name, const std::vector<Index>& residues) const override {
    return "name " + name + " " + specification(residues) + "\n";
  }
  std::string paint(const std::string&, const std::vector<Index>& residues,
                    const ColorBytes& rgb) const override {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", unsigned{rgb[0]}, unsigned{rgb[1]},
                  unsigned{rgb[2]});
    return "color " + specification(residues) + " " + text.data() + "\n";
  }

 private:
  std::string specification(const std::vector<Index>& residues) const {
    const Named parts = named(residues);
    std::vector<std::string> terms;
    for (const auto& [chain, numbers] : parts.of_chain)
      terms.push_back("/" + chain + ":" + joined(numbers, ","));
    // ChimeraX reads "a & b | c" as "a & (b | c)", and a value up to the next blank.
    for (const auto& [first, last] : parts.serials)
      terms.push_back(first == last ? "@@serial_number=" + std::to_string(first)
                                    : "(@@serial_number>=" + std::to_string(first) +
                                          " & @@serial_number<=" + std::to_string(last) + " )");
    return joined(terms, " | ");
  }
};

/// A column of a PDB file.
std::string pdb_field(const Atom& atom, const std::string& text, std::size_t width, const char* what) {
  const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (text.size() > width || !printable)
    throw core::BadInput(core::printable(atom.described()) + ": the " + what +
                         " does not fit into a PDB file (" + std::to_string(width) +
                         (width == 1 ? " character" : " characters") + "): write the residues as .csv");
  return text;
}

/// The last one that the column of temperature factors has room for.
constexpr Index kLastSegment = 999999;

std::string pdb_line(const Atom& atom, Index segment) {
  const std::string name = pdb_field(atom, atom.name, 4, "atom's name");
  const std::string residue = pdb_field(atom, atom.residue, 4, "residue's name");
  const std::string chain = pdb_field(atom, atom.chain, residue.size() == 4 ? 1 : 2, "chain's name");
  const char last = atom.sequence_id.empty() ? '0' : atom.sequence_id.back();
  const bool has_code = (last >= 'A' && last <= 'Z') || (last >= 'a' && last <= 'z');
  const std::string number = pdb_field(
      atom, atom.sequence_id.substr(0, atom.sequence_id.size() - (has_code ? 1 : 0)), 4, "residue's number");
  for (const double x : atom.position)
    if (x >= 9999.9995 || x <= -999.9995)
      throw core::BadInput(core::printable(atom.described()) +
                           ": a coordinate does not fit into a PDB file (-999.999 to 9999.999): write the "
                           "residues as .csv");
  if (segment != core::kNone && segment > kLastSegment)
    throw core::BadInput(
        "segment " + std::to_string(segment) +
        " does not fit into a PDB file, whose temperature factors have six characters: write "
        "the residues as .csv");
  const double label = segment == core::kNone ? -1 : static_cast<double>(segment);
  const std::string factor = decimals(label, label < 1000 ? "%6.2f" : label < 10000 ? "%6.1f" : "%6.0f");
  const bool is_short = name.size() < 4 && atom.element.size() == 1;
  const std::int64_t serial = atom.serial >= 0 && atom.serial <= 99999 ? atom.serial : atom.serial % 100000;
  std::string element = atom.element == "X" ? std::string() : atom.element;
  std::transform(element.begin(), element.end(), element.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(),
                "%-6s%5lld %-4s%c%*s%*s%4s%c   %8.3f%8.3f%8.3f%6.2f%6s          %2s\n",
                atom.hetero ? "HETATM" : "ATOM", static_cast<long long>(std::max<std::int64_t>(serial, 0)),
                ((is_short ? " " : "") + name).c_str(),
                atom.alternate > ' ' && atom.alternate <= '~' ? atom.alternate : ' ',
                residue.size() == 4 ? 4 : 3, residue.c_str(), residue.size() == 4 ? 1 : 2, chain.c_str(),
                number.c_str(), has_code ? last : ' ', atom.position.x(), atom.position.y(),
                atom.position.z(), std::clamp(atom.occupancy, 0.0, 999.0), factor.c_str(), element.c_str());
  return line.data();
}

void write_pdb(core::FileWriter& file, std::span<const Atom> atoms, std::span<const SegmentedAtoms> levels,
               bool with_levels) {
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const std::vector<Index> main =
        main_segments(levels[l].atoms, atoms.size(), [](Index atom) { return atom; });
    if (with_levels) file.write("MODEL     " + decimals(static_cast<double>(l + 1), "%4.0f") + "\n");
    for (std::size_t i = 0; i < atoms.size(); ++i) file.write(pdb_line(atoms[i], main[i]));
    if (with_levels) file.write("ENDMDL\n");
  }
  file.write("END\n");
}

void write_csv(core::FileWriter& file, std::span<const Atom> atoms, std::span<const SegmentedAtoms> levels,
               bool with_levels, const Provenance& provenance) {
  std::vector<std::string> columns = {"segment", "chain",   "residue", "sequence_id",
                                      "atom",    "element", "serial",  "area"};
  if (with_levels) columns.insert(columns.begin(), "level");
  CsvTable table(file.stream(), columns);
  for (std::size_t l = 0; l < levels.size(); ++l)
    for (const SegmentAtom& part : levels[l].atoms) {
      const Atom& atom = atoms[part.atom];
      CsvLine line;
      if (with_levels) line.add(std::uint64_t{l});
      line.add(std::uint64_t{part.segment});
      line.add(core::printable(atom.chain));
      line.add(core::printable(atom.residue));
      line.add(core::printable(atom.sequence_id));
      line.add(core::printable(atom.name));
      line.add(atom.element);
      line.add(std::to_string(atom.serial));
      line.add(part.area);
      table.add(line);
    }
  table.end(provenance.lines());
}

}  // namespace

std::string residues_extension(const core::FileTarget& target) {
  return core::checked_extension(target, "residues of segments are written",
                                 {".pml", ".cxc", ".pdb", ".csv"});
}

void write_residues(const core::FileTarget& target, std::span<const Atom> atoms,
                    std::span<const SegmentedAtoms> levels, bool with_levels, const Provenance& provenance) {
  const std::string extension = residues_extension(target);
  core::FileWriter file(target);
  if (extension == ".pdb") {
    file.write(provenance.pdb_remark());
    write_pdb(file, atoms, levels, with_levels);
  } else if (extension == ".csv") {
    write_csv(file, atoms, levels, with_levels, provenance);
  } else {
    file.write(provenance.script_comment());
    const Residues residues(atoms);
    const auto prefix = [&](std::size_t l) {
      return with_levels ? "level_" + std::to_string(l) + "_" : std::string();
    };
    const Serials serials(atoms, residues);
    const PymolScript pymol(atoms, residues, serials);
    const ChimeraxScript chimerax(atoms, residues, serials);
    const Script& script = extension == ".pml" ? static_cast<const Script&>(pymol) : chimerax;
    for (std::size_t l = 0; l < levels.size(); ++l) script.write(file, levels[l], prefix(l));
  }
  file.commit();
}

}  // namespace morsel::tools
