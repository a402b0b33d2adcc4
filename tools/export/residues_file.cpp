#include "morsel/tools/export/residues_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/printable.h"
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

/// Atoms of one residue, in the order of the file.
struct Residue {
  std::vector<Index> atoms;
  /// Whether chain and number are such that a script may hold them.
  bool is_plain = false;
};

class Residues {
 public:
  explicit Residues(std::span<const Atom> atoms) : of_atom_(atoms.size()) {
    std::map<std::tuple<std::string_view, std::string_view, std::string_view>, Index> number;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      const Atom& atom = atoms[i];
      const auto [place, is_new] =
          number.try_emplace({atom.chain, atom.sequence_id, atom.residue}, static_cast<Index>(all_.size()));
      if (is_new) all_.push_back({{}, is_plain_word(atom.chain) && is_plain_word(atom.sequence_id)});
      of_atom_[i] = place->second;
      all_[place->second].atoms.push_back(static_cast<Index>(i));
    }
  }

  const Residue& operator[](Index residue) const { return all_[residue]; }
  Index of_atom(Index atom) const { return of_atom_[atom]; }
  std::size_t count() const { return all_.size(); }

 private:
  std::vector<Residue> all_;
  std::vector<Index> of_atom_;
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

/// Colours that neighbours in number tell apart: hues by the golden ratio.
std::array<double, 3> colour(std::size_t number) {
  const double hue = 6 * std::fmod(static_cast<double>(number) * 0.6180339887498949, 1.0);
  const double value = number % 2 == 0 ? 0.9 : 0.7;
  std::array<double, 3> rgb{};
  for (int i = 0; i < 3; ++i) {
    const double k = std::fmod(static_cast<double>(5 - 2 * i) + hue, 6.0);
    rgb[static_cast<std::size_t>(i)] = value * (1 - 0.65 * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  }
  return rgb;
}

std::string decimals(double value, const char* pattern) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

/// What the two kinds of scripts have in common.
class Script {
 public:
  Script(std::span<const Atom> atoms, const Residues& residues) : atoms_(atoms), residues_(residues) {}
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
        file.write(paint(name, own->second, colour(segment)));
    }
  }

 protected:
  virtual std::string select(const std::string& name, const std::vector<Index>& residues) const = 0;
  virtual std::string paint(const std::string& name, const std::vector<Index>& residues,
                            const std::array<double, 3>& rgb) const = 0;

  /// The residues chain by chain, those that a script cannot name as numbers of their atoms.
  struct Named {
    std::map<std::string, std::vector<std::string>> of_chain;
    std::vector<std::string> serials;
  };
  Named named(const std::vector<Index>& residues) const {
    Named result;
    for (const Index r : residues) {
      const Atom& atom = atoms_[residues_[r].atoms.front()];
      if (residues_[r].is_plain)
        result.of_chain[atom.chain].push_back(atom.sequence_id);
      else
        for (const Index i : residues_[r].atoms) result.serials.push_back(std::to_string(atoms_[i].serial));
    }
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
};

class PymolScript final : public Script {
 public:
  using Script::Script;

 protected:
  std::string select(const std::string& name, const std::vector<Index>& residues) const override {
    return "select " + name + ", " + selection(residues) + "\n";
  }
  std::string paint(const std::string& name, const std::vector<Index>& residues,
                    const std::array<double, 3>& rgb) const override {
    std::string text = "set_color " + name + "_color, [";
    for (std::size_t i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + decimals(rgb[i], "%.3f");
    return text + "]\ncolor " + name + "_color, " + selection(residues) + "\n";
  }

 private:
  std::string selection(const std::vector<Index>& residues) const {
    const Named parts = named(residues);
    std::vector<std::string> terms;
    for (const auto& [chain, numbers] : parts.of_chain)
      terms.push_back("(chain " + chain + " and resi " + joined(numbers, "+") + ")");
    if (!parts.serials.empty()) terms.push_back("(id " + joined(parts.serials, "+") + ")");
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
                    const std::array<double, 3>& rgb) const override {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x",
                  static_cast<unsigned>(std::lround(255 * rgb[0])) & 255U,
                  static_cast<unsigned>(std::lround(255 * rgb[1])) & 255U,
                  static_cast<unsigned>(std::lround(255 * rgb[2])) & 255U);
    return "color " + specification(residues) + " " + text.data() + "\n";
  }

 private:
  std::string specification(const std::vector<Index>& residues) const {
    const Named parts = named(residues);
    std::vector<std::string> terms;
    for (const auto& [chain, numbers] : parts.of_chain)
      terms.push_back("/" + chain + ":" + joined(numbers, ","));
    for (const std::string& serial : parts.serials) terms.push_back("@@serial_number=" + serial);
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
               bool with_levels) {
  file.write(std::string(with_levels ? "level," : "") +
             "segment,chain,residue,sequence_id,atom,element,serial,area\n");
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
      file.write(line.text() + "\n");
    }
}

}  // namespace

std::string residues_extension(const std::filesystem::path& path) {
  return core::checked_extension(path, "residues of segments are written", {".pml", ".cxc", ".pdb", ".csv"});
}

void write_residues(const core::FileTarget& target, std::span<const Atom> atoms,
                    std::span<const SegmentedAtoms> levels, bool with_levels, const Provenance& provenance) {
  const std::string extension = residues_extension(target.path);
  core::FileWriter file(target);
  if (extension == ".pdb") {
    file.write(provenance.pdb_remark());
    write_pdb(file, atoms, levels, with_levels);
  } else if (extension == ".csv") {
    file.write(provenance.text_comment());
    write_csv(file, atoms, levels, with_levels);
  } else {
    file.write(provenance.script_comment());
    const Residues residues(atoms);
    const auto prefix = [&](std::size_t l) {
      return with_levels ? "level_" + std::to_string(l) + "_" : std::string();
    };
    const PymolScript pymol(atoms, residues);
    const ChimeraxScript chimerax(atoms, residues);
    const Script& script = extension == ".pml" ? static_cast<const Script&>(pymol) : chimerax;
    for (std::size_t l = 0; l < levels.size(); ++l) script.write(file, levels[l], prefix(l));
  }
  file.commit();
}

}  // namespace morsel::tools
